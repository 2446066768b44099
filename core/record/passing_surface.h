// Large curved surfaces that pass by local zero, where the detail of a scene lies then.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/record/block_lane.h"
#include "core/record/cone_floats.h"
#include "core/record/record.h"

namespace dmpc::core {

/// From this radius on, beside a scene of about 1, a body is large.
inline constexpr float passing_radius_least = 0x1p-6F;
/// Its surface passes by local zero if it comes nearer to it than this share of its radius.
inline constexpr double passing_share = 0x1p-8;

/// Whether a surface of this radius passes by local zero; `distance_squared`: from there to its centre or axis.
inline bool passes_by(double distance_squared, double radius) {
  const double square = radius * radius;
  return std::fabs(distance_squared - square) <= 2 * passing_share * square;
}

inline bool sphere_passes_by(const BlockLane& sphere) {
  const Vec3d center = sphere.vector(0);
  return passes_by(dot(center, center), sphere.value(3));
}

/// Whether a radius, or the larger one of a cone, may be that of a large body.
inline bool is_large(float base_radius, float apex_radius) {
  return std::max(std::fabs(base_radius), std::fabs(apex_radius)) >= passing_radius_least;
}

/// A cone or cylinder that is about as wide as it is far away, between its ends. One that is long beside its radius has its
/// place across it by all of its ends' bits.
inline bool cone_passes_by(const ConeFloats& cone) {
  constexpr double widths_away_max = 8;
  const double widest = cone.widest();
  const double farthest = std::max(largest_component(cone.base), largest_component(cone.apex));
  if (cone.is_flat || !(farthest <= widths_away_max * widest)) {
    return false;
  }
  const double height = -dot(cone.base, cone.axis) / dot(cone.axis, cone.axis);
  const Vec3d across = cone.base + cone.axis * height;
  return height >= 0.0 && height <= 1.0 && passes_by(dot(across, across), cone.radius_at(height));
}

/// Whether a sphere or cone passes by local zero, by its floats alone. The place of such a surface there hangs on few bits of
/// numbers that are as large as its radius. So its radius makes good what rounding moved its centre, or its ends, by, and has
/// more of the rests than they (core/record/curved_values.h). In a scene whose grid begins at local zero there is none.
inline bool passes_by_zero(PrimitiveKind kind, const BlockLane& curved) {
  const float* const values = curved.rows + curved.lane;
  if (kind == PrimitiveKind::sphere) {
    return is_large(values[3 * curved.stride], 0.0F) && sphere_passes_by(curved);
  }
  return is_large(values[3 * curved.stride], values[7 * curved.stride]) && cone_passes_by(ConeFloats(curved));
}

}  // namespace dmpc::core
