// What rounding to the grid's coordinates leaves nothing of.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/vec.h"

namespace dmpc::core {

/// What is smaller than this, beside a scene of about 1, no ray in floats can tell from a point.
inline constexpr double size_least = 0x1p-40;

/// Decided on the floats that are stored: area first, which most have, then equal corners, whose area need not come out as 0
/// where products are fused, then size.
inline bool leaves_nothing(const std::array<Vec3d, 3>& corner) {
  const Vec3d &a = corner[0], &b = corner[1], &c = corner[2];
  const Vec3d area = cross(b - a, c - a);
  const double squared = dot(area, area);  // at most 9 times the fourth power of the size
  if (squared > 16 * size_least * size_least * size_least * size_least) {
    return false;
  }
  if (a == b || b == c || c == a || !(squared > 0)) {
    return true;
  }
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size = std::max(size, std::max({a[axis], b[axis], c[axis]}) - std::min({a[axis], b[axis], c[axis]}));
  }
  return size < size_least;
}

}  // namespace dmpc::core
