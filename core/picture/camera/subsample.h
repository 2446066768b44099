// A small picture in place of a large one: which pixels represent all.
#pragma once

#include <cstdint>
#include <vector>

namespace dmpc::core {

/// The pixels of the subsampled picture, in scan order: the middle one of every full subsample x subsample square, at least one.
/// Requires sizes and `subsample` of 1 or more.
std::vector<std::uint32_t> subsampled_pixels(int width, int height, int subsample);

}  // namespace dmpc::core
