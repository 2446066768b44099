// Regions that nobody chose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/region.h"

namespace dmpc::tests {

/// Cuts a grid of `size` finest cells into `count` boxes that tile it, at multiples of `step` cells, by the numbers that draw()
/// gives.
template <class Draw>
std::vector<core::Region> random_regions(const core::Corner& size, std::size_t count, Draw&& draw, std::int32_t step = 1) {
  std::vector<core::Region> regions{{.high = size}};
  while (regions.size() < count) {
    const std::size_t victim = draw() % regions.size(), axis = draw() % 3;
    core::Region& low = regions[victim];
    if (low.high[axis] - low.low[axis] < 2 * step) {
      continue;
    }
    core::Region high = low;
    const auto room = static_cast<std::uint32_t>((low.high[axis] - low.low[axis]) / step - 1);
    low.high[axis] = high.low[axis] = low.low[axis] + step * (1 + static_cast<std::int32_t>(draw() % room));
    regions.push_back(high);
  }
  return regions;
}

}  // namespace dmpc::tests
