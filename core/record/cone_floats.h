// What the floats of a cone say, without their rests.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/vec.h"
#include "core/record/block_lane.h"

namespace dmpc::core {

/// A cone as thin as this share of its radius is flat: used as a disc or a ring.
inline constexpr double flat_cone_share = 0x1p-6;

/// Of a flat cone rounding the two ends apart would leave no axis, so the rows of its apex hold the way there from the base, and
/// the signs of its radii differ.
inline bool is_flat_cone(float base_radius, float apex_radius) { return std::signbit(base_radius) != std::signbit(apex_radius); }
/// Either way the base's radius has a negative sign if the cone shows its inside only.
inline bool shows_inside_only(float base_radius) { return std::signbit(base_radius); }

/// A cone by its rows of a block: base, radius, apex, radius (core/record/record.h).
struct ConeFloats {
  explicit ConeFloats(const BlockLane& cone)
      : base(cone.vector(0)),
        is_flat(is_flat_cone(cone.rows[3 * cone.stride + cone.lane], cone.rows[7 * cone.stride + cone.lane])),
        axis(is_flat ? cone.vector(4) : cone.vector(4) - base),
        apex(is_flat ? base + axis : cone.vector(4)),
        base_radius(std::fabs(cone.value(3))),
        apex_radius(std::fabs(cone.value(7))) {}

  double widest() const { return std::max(base_radius, apex_radius); }
  /// At a share of the way from base to apex.
  double radius_at(double height) const { return base_radius + (apex_radius - base_radius) * height; }

  Vec3d base;
  bool is_flat;
  Vec3d axis, apex;                 ///< axis: from base to apex
  double base_radius, apex_radius;  ///< without their signs
};

}  // namespace dmpc::core
