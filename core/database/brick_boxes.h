// Boxes of a brick's children.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/bounds.h"
#include "core/record/record.h"

namespace dmpc::core {

inline constexpr std::uint32_t brick_bound_max = 255;

/// A brick without children that can hold groups within `bounds`, padded.
inline Brick brick_over(const Bounds& bounds, double pad) {
  Brick brick;
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    brick.origin[axis] = rounded_down(double{bounds.low[axis]} - pad);
    size = std::max(size, double{bounds.high[axis]} + pad - double{brick.origin[axis]});
  }
  int exponent = 0;
  std::frexp(size / brick_bound_max, &exponent);
  brick.unit = std::ldexp(1.0F, exponent);
  return brick;
}

/// The next child, whose box, padded, such a brick can hold.
inline void add_child(Brick& brick, const Bounds& bounds, double pad) {
  const std::size_t child = brick.child_count++;
  const double unit = double{brick.unit};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double origin = double{brick.origin[axis]};
    brick.bounds[axis][child] = static_cast<std::uint8_t>((double{bounds.low[axis]} - pad - origin) / unit);
    brick.bounds[axis + 3][child] = static_cast<std::uint8_t>(std::ceil((double{bounds.high[axis]} + pad - origin) / unit));
  }
}

}  // namespace dmpc::core
