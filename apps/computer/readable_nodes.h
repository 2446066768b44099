// How many nodes a page shows one by one.
#pragma once

#include <cstdint>

namespace dmpc::apps {

/// Neither bars nor pairs of more nodes can be told apart, and they would make a page of tens of megabytes.
inline constexpr std::uint32_t readable_nodes_max = 256;

}  // namespace dmpc::apps
