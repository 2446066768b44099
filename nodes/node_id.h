// The name of a node.
#pragma once

#include <cstdint>

namespace dmpc::nodes {

/// 0 .. node_count - 1 are the nodes; node_count is the host.
enum class NodeId : std::uint32_t {};

constexpr std::uint32_t index_of(NodeId id) { return static_cast<std::uint32_t>(id); }

}  // namespace dmpc::nodes
