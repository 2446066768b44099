// Finds which nodes wait for each other in a deadlock, from unanswered packets.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/computer/dmpc/computer.h"

namespace dmpc::apps {

/// Unanswered packets of one kind that a node expects or owes.
struct Unanswered {
  std::uint32_t node = 0;
  std::string answer;
  std::uint32_t count = 0;
};

/// Serializes the list for other ranks; never empty.
std::string flat_bytes(const std::vector<Unanswered>& list);
std::vector<Unanswered> unanswered_from(const std::string& bytes);

/// Returns "; waits for 2 'taken' of node 3; owes 1 'taken' to node 1", limited to a few nodes each; empty if there are none.
std::string waiting_text(const std::vector<Unanswered>& awaited, const std::vector<Unanswered>& owed);

/// Describes a cycle of nodes that wait for each other, after a newline; empty if there is none. `awaited` is indexed by node.
std::string circle_text(const std::vector<std::vector<Unanswered>>& awaited);

}  // namespace dmpc::apps
