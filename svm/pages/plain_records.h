// What any node's records answer to whoever runs tasks over them, and what they do unless their kind hides it.
#pragma once

#include <cstdint>

#include "nodes/charge.h"
#include "nodes/program.h"
#include "svm/pages/node_program.h"

namespace dmpc::svm {

/// A base of what a node has of the database (Pager, and outside of pages a whole copy, or a forest). Each kind has besides, for
/// those whose tasks it serves:
///   receive(packet, waiting) takes a packet about records, goes on with tasks for which it brings something, and returns false
///     for any other packet;
///   lacks(slot, waiting)     sees to it that the task there goes on when it has what find() has just said is absent;
///   counters()               of look-ups.
/// Nothing is virtual: what a kind does is known where programs are compiled. Thread safety: belongs to one node.
struct PlainRecords {
  /// What tasks wait for, as reports call it.
  static constexpr const char* awaited = "pages";

  /// References from now on are those of the task in `slot`.
  void select(std::uint32_t /*slot*/) {}
  /// The selected slot starts another task.
  void forget() {}
  /// Nothing can go on until a packet comes: sends what may have waited for more of its kind.
  void flush() {}
  /// How many answers of others are awaited.
  std::uint32_t pending() const { return 0; }
  QuestionCounters questions() const { return {}; }
  /// Adds what a model asks a price for.
  void add_charges(nodes::Charges& /*charges*/) const {}
  nodes::Levels levels() const { return {}; }
};

}  // namespace dmpc::svm
