// The name of a node.
#pragma once

#include <cstdint>

namespace dmpc::nodes {

/// 0 .. node_count - 1 are the nodes; node_count is the host.
enum class NodeId : std::uint32_t {};

/// The maximum number of nodes. Beyond it each node's tables of all others would exceed most memories, and packets store their
/// senders in 16 bits.
inline constexpr std::uint32_t node_count_max = 4096;

constexpr std::uint32_t index_of(NodeId id) { return static_cast<std::uint32_t>(id); }

}  // namespace dmpc::nodes
