// Views that show nothing.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/box.h"
#include "core/scene/scene.h"
#include "core/scene/transform.h"

namespace dmpc::apps {

/// Limit for coordinates of the view's points and of lights: beyond it, squares of distances exceed the range of floats.
inline constexpr double view_coordinate_max = 1e30;
/// Whether all coordinates are numbers within the limit.
bool is_in_reach(const core::Vec3d& point);
/// Whether all transformed corners are.
bool is_in_reach(const core::Box& box, const core::Transform& world);

enum class ViewFault : std::uint8_t {
  angle,      ///< not between 0 and 180 degrees, both excluded
  far_from,   ///< `from` has a coordinate beyond view_coordinate_max, or not a number
  far_at,     ///< `at` is too far away
  direction,  ///< from and at are one point
  up          ///< zero, or parallel to the line from `from` to `at`
};

/// The first fault, in that order.
std::optional<ViewFault> fault_of(const core::View& view);

}  // namespace dmpc::apps
