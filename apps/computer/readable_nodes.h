// How many nodes a page shows in pairs.
#pragma once

#include <cstdint>

namespace dmpc::apps {

/// Pairs of more nodes cannot be told apart, and they would make a page of tens of megabytes.
inline constexpr std::uint32_t readable_nodes_max = 256;

}  // namespace dmpc::apps
