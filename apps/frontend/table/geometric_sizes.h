// Geometric sequences of sizes to try.
#pragma once

#include <cstdint>
#include <vector>

namespace dmpc::apps {

/// Returns at most `count` distinct sizes from 1 to `most`, with a nearly constant ratio; none if `most` is 0. Requires count >=
/// 2.
std::vector<std::uint32_t> geometric_sizes(std::uint32_t most, std::uint32_t count);

}  // namespace dmpc::apps
