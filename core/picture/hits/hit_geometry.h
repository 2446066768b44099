// Where a ray hit: the point, the normals, and the material's properties that the leaf holds.
#pragma once

#include <cstddef>

#include "core/picture/hits/hit_state.h"
#include "core/picture/hits/triangle_hit.h"
#include "core/record/record.h"

namespace dmpc::core {

/// The primitive that was hit, in its leaf.
LeafLane lane_of(const HitState& state, const std::byte* record);

/// From the leaf of the primitive that was hit: sets everything that `state` says of the surface, and the next stage. The point
/// lies on the primitive, even if the ray passes beside it by rounding.
void read_geometry(HitState& state, const std::byte* record);

/// read_geometry() without point, weights, true normal and clearance, which are set already.
void read_surface(HitState& state, const std::byte* record);

/// The part of a triangle's plane that is covered by a disc around the ray, perpendicular to the unit vector `upright`, projected
/// along the ray: upright is the view direction if the disc lies on the camera's film, and the ray itself for a cone. From the
/// same record, after read_geometry().
CutEllipse cut_ellipse(const HitState& state, const std::byte* record, const Vec3d& upright);

// Relative to the largest coordinate and radius: curved surfaces are solved in double from rays that are exact to 2^-49, but
// other surfaces that continue there may be off by a few times the rounding error of a value with its rest.
inline constexpr double curved_clearance = 0x1p-40, curved_going_on = 0x1p-28;
/// Far less for a surface that passes by local zero (core/record/curved_values.h): others that continue there are off by a share
/// of the distance from local zero, and what is next to it may be small.
inline constexpr double passing_clearance = 0x1p-44, passing_going_on = 0x1p-22;

/// `size`: the largest coordinate and radius; `radius`: of the surface at the hit.
inline Clearance clearance_on_curved(const HitState& state, double size, double radius, bool passes_by) {
  const double tie = tie_clearance * double{state.hit.t};
  if (passes_by) {
    return {passing_clearance * size + passing_going_on * largest_component(state.point) + tie, passing_clearance * size, radius};
  }
  return {curved_going_on * size + tie, curved_clearance * size, radius};
}

}  // namespace dmpc::core
