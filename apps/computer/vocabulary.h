// The names of a program's packets, operations and memory, and the corresponding numbers of the underlying computer.
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

/// The packets of a program of tasks over pages request and deliver pages.
struct Vocabulary {
  std::vector<NamedPacket> packets;
  std::vector<NamedOperation> operations;  ///< the program's own
  std::vector<NamedOperation> of_pages;    ///< operations with a price of the machine; empty without pages
  std::vector<std::string> memory;         ///< names of the pieces of memory

  bool has_pages() const { return !of_pages.empty(); }
};

Vocabulary vocabulary_of(const Needs& needs);
/// Throws core::UsageError for too many or invalid operations.
Vocabulary vocabulary_of_tasks(const std::vector<OperationNeed>& operations);

/// Returns the underlying charge of an operation of a program of tasks, which comes between those of pages.
core::Charge charge_of(Index operation);

}  // namespace dmpc::apps
