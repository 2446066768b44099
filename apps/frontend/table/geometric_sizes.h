// Sizes to try where any could be tried.
#pragma once

#include <cstdint>
#include <vector>

namespace dmpc::apps {

/// At most `count` sizes from 1 to `most`, each about the same times the one before, without repetition. Requires count >= 2;
/// nothing if `most` is 0.
std::vector<std::uint32_t> geometric_sizes(std::uint32_t most, std::uint32_t count);

}  // namespace dmpc::apps
