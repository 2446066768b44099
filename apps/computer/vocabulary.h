// What the nodes of a program send, are charged and allocate: its own names, and the numbers that the computer below has for
// them.
#pragma once

#include <string>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "core/trace/charge.h"

namespace dmpc::apps {

struct NamedPacket {
  std::string name;
  std::string key;  ///< in --stats
  Index kind = 0;
};

struct NamedOperation {
  std::string name;
  Index charge = 0;
  double nanoseconds = 0;  ///< on a core of today
};

/// A program of tasks over pages is one whose packets ask for pages and bring them.
struct Vocabulary {
  std::vector<NamedPacket> packets;
  std::vector<NamedOperation> operations;  ///< the program's own
  std::vector<NamedOperation> of_pages;    ///< operations whose price a machine knows by itself; none where there are no pages
  std::vector<std::string> memory;         ///< names of its pieces

  bool has_pages() const { return !of_pages.empty(); }
};

Vocabulary vocabulary_of(const Needs& needs);
/// Throws core::UsageError for too many operations, or such as cannot be.
Vocabulary vocabulary_of_tasks(const std::vector<OperationNeed>& operations);

/// What the computer below calls an operation of a program of tasks, between those of pages.
core::Charge charge_of(Index operation);

}  // namespace dmpc::apps
