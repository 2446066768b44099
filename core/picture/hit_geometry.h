// Where a ray hit: the point, the normals, and what of the material is known from the block alone.
#pragma once

#include <cstddef>

#include "core/picture/hit_state.h"
#include "core/record/block_lane.h"

namespace dmpc::core {

/// The primitive that was hit, in its block.
BlockLane lane_of(const HitState& state, const std::byte* record);

/// From the block of the primitive that was hit: sets all that `state` says of the surface, and the stage that follows. The point
/// lies on the primitive, whatever rounding let the ray in.
void read_geometry(HitState& state, const std::byte* record);

/// All of that but point, weights, true normal and clearance, which are set already.
void read_surface(HitState& state, const std::byte* record);

/// What is covered of a triangle's plane by a disc about the ray that stands at a right angle on the unit vector `upright`, seen
/// along the ray: upright is where the camera looks if the disc lies on its film, and the ray itself if a cone is meant. From the
/// same record, after read_geometry().
CutEllipse cut_ellipse(const HitState& state, const std::byte* record, const Vec3d& upright);

}  // namespace dmpc::core
