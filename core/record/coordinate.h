// Coordinates as records and rays have them: floats on a lattice.
#pragma once

#include <cmath>

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

}  // namespace dmpc::core
