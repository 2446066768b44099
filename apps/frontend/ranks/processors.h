// Which processors each rank may use, and what they come to where ranks share them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nodes/ranks/backoff.h"

namespace dmpc::apps {

/// The processors of one rank.
struct RankProcessors {
  std::string host;
  std::vector<int> numbers;  ///< processors that the launcher or the system allows it, ascending
  bool operator==(const RankProcessors&) const = default;
};

/// This process's; none if the computer has more than a set of usual size can say.
RankProcessors own_processors(const std::string& host);
/// As one line, to be said to other ranks.
std::string text_of(const RankProcessors& processors);
/// What text_of() has made. Throws core::InternalError for any other text.
RankProcessors parse_processors(const std::string& text);

/// How many processors rank `rank` may use, each counted by the part that falls to it: one that three ranks of a host may use
/// is a third of a processor to each.
double share_of_processors(const std::vector<RankProcessors>& by_rank, std::uint32_t rank);

/// How many nodes a rank with this share has where nobody says: one processor is the communicating thread's, and one node is
/// there at least.
std::uint32_t default_nodes_on(double processor_share);

/// What a communicating thread does where nobody says: it spins if its rank has a processor more than nodes.
nodes::Idle default_idle(double processor_share, std::uint32_t node_count_here);

}  // namespace dmpc::apps
