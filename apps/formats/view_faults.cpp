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
  return std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}) <= view_coordinate_max && is_finite(point);
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
