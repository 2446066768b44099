// Who waits for whom when all stand still, as far as the computer can tell: by packets that are not answered.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/computer/dmpc/computer.h"

namespace dmpc::apps {

/// Answers of one kind that are to come from a node, or that it is to get.
struct Unanswered {
  std::uint32_t node = 0;
  std::string answer;
  std::uint32_t count = 0;
};

/// As they travel between ranks; there is always a byte.
std::string flat_bytes(const std::vector<Unanswered>& list);
std::vector<Unanswered> unanswered_from(const std::string& bytes);

/// "; waits for 2 'taken' of node 3; owes 1 'taken' to node 1", of at most a few nodes each; empty if there is nothing.
std::string waiting_text(const std::vector<Unanswered>& awaited, const std::vector<Unanswered>& owed);

/// `awaited` by node. A line on nodes that wait for each other in a circle, with a line's end before it; empty if there is none.
std::string circle_text(const std::vector<std::vector<Unanswered>>& awaited);

}  // namespace dmpc::apps
