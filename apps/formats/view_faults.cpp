#include "apps/formats/view_faults.h"

#include <algorithm>
#include <cmath>

namespace dmpc::apps {
namespace {

using core::Vec3d;

/// `a` with its largest component brought to 1, so that no product of it overflows or vanishes; zero stays.
Vec3d to_unit_size(const Vec3d& a) {
  const double largest = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  return largest > 0 ? Vec3d{a.x / largest, a.y / largest, a.z / largest} : a;
}

}  // namespace

bool is_in_reach(const Vec3d& point) {
  return std::abs(point.x) <= view_coordinate_max && std::abs(point.y) <= view_coordinate_max &&
         std::abs(point.z) <= view_coordinate_max;
}

bool is_in_reach(const core::Box& box, const core::Transform& world) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto side = [&](unsigned axis) { return ((corner >> axis) & 1U) == 0 ? box.low[axis] : box.high[axis]; };
    if (!is_in_reach(world.point({side(0), side(1), side(2)}))) {
      return false;
    }
  }
  return true;
}

std::optional<ViewFault> fault_of(const core::View& view) {
  if (!(view.angle_degrees > 0 && view.angle_degrees < 180)) {
    return ViewFault::angle;
  }
  if (!is_in_reach(view.from) || !is_in_reach(view.at)) {
    return is_in_reach(view.from) ? ViewFault::far_at : ViewFault::far_from;
  }
  if (view.from == view.at) {
    return ViewFault::direction;
  }
  const Vec3d direction = to_unit_size(view.at - view.from), up = to_unit_size(view.up);
  return core::length(core::cross(direction, up)) > 1e-9 ? std::nullopt : std::optional(ViewFault::up);
}

}  // namespace dmpc::apps
