// Affine maps of pbrt's transform statements, in double precision.
#pragma once

#include <optional>

#include "apps/foreign/mesh/transform.h"
#include "core/base/vec.h"

namespace dmpc::apps::pbrt {

/// Returns nothing for singular maps and for inverses beyond the range of doubles.
std::optional<Transform> inverse_of(const Transform& map);

Transform translation(const core::Vec3d& by);
Transform scaling(const core::Vec3d& by);
/// Rotates counter-clockwise in right-handed coordinates by at most 1e6 degrees in magnitude; the axis has any length above 0.
Transform rotation(double degrees, const core::Vec3d& axis);
/// Maps the world to a camera at `from` that looks at `at`: z ahead, y up, x to the right. Returns nothing if the direction of
/// view is undefined or parallel to `up`.
std::optional<Transform> look_at(const core::Vec3d& from, const core::Vec3d& at, const core::Vec3d& up);

}  // namespace dmpc::apps::pbrt
