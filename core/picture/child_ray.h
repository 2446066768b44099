// A ray that a hit sends.
#pragma once

#include <cstdint>
#include <limits>

#include "core/base/vec.h"
#include "core/picture/hit_state.h"
#include "core/picture/ray_start.h"
#include "core/record/ray.h"

namespace dmpc::core {

/// Makes `ray` a child of the hit, of which its way, its weight and, where textures ask for it, its cone are still to be set.
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
