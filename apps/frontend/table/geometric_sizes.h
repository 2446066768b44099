// Geometric sequences of sizes to try.
#pragma once

#include <cstdint>
#include <vector>

namespace dmpc::apps {

/// At most `count` distinct sizes from 1 to `most`, with a nearly constant ratio. Requires count >= 2; empty if `most` is 0.
std::vector<std::uint32_t> geometric_sizes(std::uint32_t most, std::uint32_t count);

}  // namespace dmpc::apps
