// Coordinates as records and rays have them, floats on a lattice, and what rounding to them leaves nothing of.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/base/vec.h"

namespace dmpc::core {

/// Grid-local coordinates and radii, and where rays start, are multiples of this. Next to local zero floats alone would go on for
/// ever, and what kernels make of their differences, products of two and of three, would underflow. Far less than what a picture
/// can show: a scene that is 10^9 times as large as a thing leaves that 2^24 steps.
inline constexpr double coordinate_step = 0x1p-54;

/// The nearest multiple of coordinate_step, where floats are finer.
inline double on_lattice(double value) {
  constexpr double steps = 1.5 * 0x1p52 * coordinate_step;  // next to it doubles are multiples of coordinate_step
  return std::fabs(value) < 0x1p-30 ? value + steps - steps : value;
}
inline float coordinate_of(double value) { return static_cast<float>(on_lattice(value)); }
inline Vec3f coordinates_of(const Vec3d& point) {
  return {coordinate_of(point.x), coordinate_of(point.y), coordinate_of(point.z)};
}

/// By so much of the largest coordinates, each by its share in the normal: more than what doubles leave of a ray's start, and of
/// its way to the plane.
inline constexpr double exact_clearance = 0x1p-47;
/// What two floats, in which a start is kept, leave of each of its coordinates.
inline constexpr double start_rounding = 0x1p-48;

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
