// The processors that each rank may use, and their shares where ranks share them.
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

/// This process's; empty if the computer has more than a set of usual size can hold.
RankProcessors own_processors(const std::string& host);
/// As one line, to be sent to other ranks.
std::string text_of(const RankProcessors& processors);
/// Parses a text of text_of(). Throws core::InternalError for any other text.
RankProcessors parse_processors(const std::string& text);

/// The number of processors that rank `rank` may use, where shared processors count in part: a processor that three ranks of a
/// host may use counts as a third for each.
double share_of_processors(const std::vector<RankProcessors>& by_rank, std::uint32_t rank);

/// Default number of nodes of a rank with this share: one processor is for the communicating thread; at least one node.
std::uint32_t default_nodes_on(double processor_share);

/// Default behaviour of an idle communicating thread: it spins if its rank has more processors than nodes.
nodes::Idle default_idle(double processor_share, std::uint32_t node_count_here);

}  // namespace dmpc::apps
