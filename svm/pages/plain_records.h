// The interface of a node's records for tasks, with default implementations, which kinds of records hide.
#pragma once

#include <cstdint>

#include "nodes/charge.h"
#include "nodes/program.h"
#include "svm/pages/node_program.h"

namespace dmpc::svm {

/// A base of a node's part of the database (Pager, and without pages a whole copy, or a forest). Each kind also has:
///   receive(packet, waiting) takes a packet about records, continues the tasks for which it brings something, and returns false
///     for any other packet;
///   lacks(slot, waiting)     lets the task there wait for what find() has just reported absent;
///   counters()               counts look-ups.
/// Nothing is virtual: kinds are known when programs are compiled. Thread safety: belongs to one node.
struct PlainRecords {
  /// What tasks wait for, for reports.
  static constexpr const char* awaited = "pages";

  /// References from now on belong to the task in `slot`.
  void select(std::uint32_t /*slot*/) {}
  /// The selected slot starts another task.
  void forget() {}
  /// To be called when nothing can go on until a packet arrives: sends packets that are not full.
  void flush() {}
  /// Number of answers that are awaited.
  std::uint32_t pending() const { return 0; }
  QuestionCounters questions() const { return {}; }
  /// Adds operations that a model has a price for.
  void add_charges(nodes::Charges& /*charges*/) const {}
  nodes::Levels levels() const { return {}; }
};

}  // namespace dmpc::svm
