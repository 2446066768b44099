// Affine maps as pbrt's statements make them, in double precision.
#pragma once

#include <optional>

#include "apps/foreign/mesh/transform.h"
#include "core/base/vec.h"

namespace dmpc::apps::pbrt {

/// Nothing of what presses space flat, or whose numbers are beyond what doubles hold.
std::optional<Transform> inverse_of(const Transform& map);

Transform translation(const core::Vec3d& by);
Transform scaling(const core::Vec3d& by);
/// About an axis of any length above 0, by degrees of at most 1e6 in magnitude, counter-clockwise in right-handed coordinates.
Transform rotation(double degrees, const core::Vec3d& axis);
/// From the world to a camera that looks from `from` to `at`: z ahead, y up, x to the right. Nothing if that has no direction, or
/// `up` points along it.
std::optional<Transform> look_at(const core::Vec3d& from, const core::Vec3d& at, const core::Vec3d& up);

}  // namespace dmpc::apps::pbrt
