// A ray that a hit sends.
#pragma once

#include <cstdint>

#include "core/base/vec.h"
#include "core/picture/hit_state.h"
#include "core/picture/ray_start.h"
#include "core/record/ray.h"

namespace dmpc::core {

/// A shadow ray ends this share of its length before the light.
inline constexpr double light_gap = 1e-6;

/// A child along the unit direction `towards`.
inline Ray child_ray(const HitState& state, const Vec3d& towards, const RayStart& start, RayKind kind) {
  Ray ray;
  ray.start_at(state.point + towards * start.along + state.geometric_normal * start.across);
  ray.go_along(towards);
  ray.ignored_primitive = state.curved ? no_primitive : state.hit.primitive;
  ray.pixel = state.ray.pixel;
  ray.sample = state.ray.sample;
  ray.depth = static_cast<std::uint8_t>(state.ray.depth + (kind == RayKind::shadow ? 0 : 1));
  ray.kind = kind;
  return ray;
}

}  // namespace dmpc::core
