// Where a ray hit: the point, the normals, and what of the material is known from the leaf alone.
#pragma once

#include <cstddef>

#include "core/picture/hits/hit_state.h"
#include "core/picture/hits/triangle_hit.h"
#include "core/record/record.h"

namespace dmpc::core {

/// The primitive that was hit, in its leaf.
LeafLane lane_of(const HitState& state, const std::byte* record);

/// From the leaf of the primitive that was hit: sets all that `state` says of the surface, and the stage that follows. The point
/// lies on the primitive, whatever rounding let the ray in.
void read_geometry(HitState& state, const std::byte* record);

/// All of that but point, weights, true normal and clearance, which are set already.
void read_surface(HitState& state, const std::byte* record);

/// What is covered of a triangle's plane by a disc about the ray that stands at a right angle on the unit vector `upright`, seen
/// along the ray: upright is where the camera looks if the disc lies on its film, and the ray itself if a cone is meant. From the
/// same record, after read_geometry().
CutEllipse cut_ellipse(const HitState& state, const std::byte* record, const Vec3d& upright);

// By the largest coordinate and radius: curved surfaces are solved in double from rays that are exact to 2^-49, but other
// surfaces that go on there may be off by a few times what rounding takes of a value with its rest.
inline constexpr double curved_clearance = 0x1p-40, curved_going_on = 0x1p-28;
/// Of one that passes by local zero (core/record/curved_values.h), far less: others that go on there are off by a share of the
/// way from local zero, and what is next to it may be small.
inline constexpr double passing_clearance = 0x1p-44, passing_going_on = 0x1p-22;

/// `size`: the largest coordinate and radius; `radius`: of the surface where it was hit.
inline Clearance clearance_on_curved(const HitState& state, double size, double radius, bool passes_by) {
  const double tie = tie_clearance * double{state.hit.t};
  if (passes_by) {
    return {passing_clearance * size + passing_going_on * largest_component(state.point) + tie, passing_clearance * size, radius};
  }
  return {curved_going_on * size + tie, curved_clearance * size, radius};
}

}  // namespace dmpc::core
