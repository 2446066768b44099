// Which rank a node is on.
#pragma once

#include <cstdint>

namespace dmpc::nodes {

/// The rank of a node, or of the host, whose index is node_count: blocks keep neighbours together, the host is on rank 0. Each
/// rank has a node where there are at least as many nodes as ranks.
constexpr std::uint32_t rank_of(std::uint32_t index, std::uint32_t node_count, std::uint32_t rank_count) {
  return index == node_count ? 0 : static_cast<std::uint32_t>(std::uint64_t{index} * rank_count / node_count);
}

}  // namespace dmpc::nodes
