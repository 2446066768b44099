// Where rays leave a surface, and the child rays of a hit.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/vec.h"
#include "core/picture/hits/hit_state.h"
#include "core/record/ray.h"

namespace dmpc::core {

/// A ray that grazes its surface starts at most this many clearances along its direction.
inline constexpr double clearances_along = 8;

/// Where a ray starts: this far along its direction from the hit's point, then along the true normal.
struct RayStart {
  double along, across;
};

/// Off the surface with this true normal, on the side of the unit direction `towards`: along that direction as far as possible,
/// since that does not change where the ray leads. Within a sphere of radius r its chord is 2 r cos long.
inline RayStart start_towards(const Vec3d& towards, const Vec3d& true_normal, const Clearance& clearance) {
  const double cosine = dot(towards, true_normal), steep = std::fabs(cosine);
  const double by_steepness = clearance.along / steep, most = clearance.along * clearances_along;
  const double along = std::min(steep * clearances_along > 1.0 ? by_steepness : most, clearance.radius * steep);
  return {along, std::copysign(std::max(clearance.across - along * steep, 0.0), cosine)};
}

/// Sets the start of a ray that leaves a surface's point, and its unit direction `towards`.
inline void leave(Ray& ray, const Vec3d& point, const Vec3d& true_normal, const Vec3d& towards, const RayStart& start) {
  ray.start_at(point + towards * start.along + true_normal * start.across);
  ray.go_along(towards);
}

/// The mirrored ray's direction, of unit length up to rounding.
inline Vec3d mirrored_direction(const Vec3d& direction, const Vec3d& normal) {
  return direction - normal * (2.0 * dot(direction, normal));
}

/// The squared cosine behind the surface by Snell's law; below 0 there is no refracted ray. `relative_index`: of the medium
/// before the surface over that behind.
inline double refracted_cosine_squared(const Vec3d& direction, const Vec3d& normal, double relative_index) {
  const double cosine = dot(direction, normal);
  return 1.0 - relative_index * relative_index * (1.0 - cosine * cosine);
}

/// The refracted ray's direction, if there is one, like mirrored_direction().
inline Vec3d bent_direction(const Vec3d& direction, const Vec3d& normal, double relative_index) {
  const double behind = std::sqrt(refracted_cosine_squared(direction, normal, relative_index));
  return direction * relative_index + normal * (relative_index * -dot(direction, normal) - behind);
}

/// Makes `ray` a child of the hit; its direction, weight and, if textures need it, cone are still to be set.
inline void begin_child(Ray& ray, const HitState& state, RayKind kind) {
  ray.t_max = std::numeric_limits<float>::infinity();
  ray.ignored_primitive = state.curved ? no_primitive : state.hit.primitive;
  ray.pixel = state.ray.pixel;
  ray.sample = state.ray.sample;
  ray.density = 0;
  ray.depth = static_cast<std::uint8_t>(state.ray.depth + (kind == RayKind::shadow ? 0 : 1));
  ray.kind = kind;
  ray.cone = 0;
}

/// A child along the unit direction `towards`.
inline Ray child_ray(const HitState& state, const Vec3d& towards, const RayStart& start, RayKind kind) {
  Ray ray;
  begin_child(ray, state, kind);
  leave(ray, state.point, state.geometric_normal, towards, start);
  return ray;
}

}  // namespace dmpc::core
