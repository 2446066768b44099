// Where rays leave a surface.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/vec.h"
#include "core/picture/hit_state.h"

namespace dmpc::core {

/// A ray that grazes its surface starts no farther along its way than so many clearances.
inline constexpr double clearances_along = 8;

/// Where a ray starts: so far along its way from the hit's point, then along the true normal.
struct RayStart {
  double along, across;
};

/// Off the surface with this true normal, on the side of the unit direction `towards`: along the way as far as may be, since that
/// leads nowhere else. Within a sphere of radius r the way is 2 r cos long.
inline RayStart start_towards(const Vec3d& towards, const Vec3d& true_normal, const Clearance& clearance) {
  const double cosine = dot(towards, true_normal), steep = std::fabs(cosine);
  const double by_steepness = clearance.along / steep, most = clearance.along * clearances_along;
  const double along = std::min(steep * clearances_along > 1.0 ? by_steepness : most, clearance.radius * steep);
  return {along, std::copysign(std::max(clearance.across - along * steep, 0.0), cosine)};
}

inline Vec3d mirrored_direction(const Vec3d& direction, const Vec3d& normal) {
  return direction - normal * (2.0 * dot(direction, normal));
}

}  // namespace dmpc::core
