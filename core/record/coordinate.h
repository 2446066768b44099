// Coordinates of records and rays: floats on a lattice; and what is degenerate after rounding to them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/base/vec.h"

namespace dmpc::core {

/// Grid-local coordinates and radii, and rays' starts, are multiples of this. Otherwise floats near local zero would have no
/// lower bound, and kernels' products of two and three of their differences would underflow. It is far below what a picture can
/// show: with a scene 10^9 times as large as an object, 2^24 steps are left for the object.
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

/// A clearance as a share of the largest coordinates, weighted by the normal's components: more than the error in doubles of a
/// ray's start, and of its distance to the plane.
inline constexpr double exact_clearance = 0x1p-47;
/// The relative error of each coordinate of a start, which is stored in two floats.
inline constexpr double start_rounding = 0x1p-48;

/// In a scene of size about 1, rays in floats cannot tell anything smaller than this from a point.
inline constexpr double size_least = 0x1p-40;

/// Decided on the stored floats: first by area, which is positive for most, then by equal corners, whose area need not be 0 with
/// fused products, then by size.
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
