// A thread of a plain renderer, which queries Embree with one ray at a time for surfaces and their direct light.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/lab/bench/speed/plain_stage.h"
#include "core/base/vec.h"

namespace dmpc::apps {

template <class T>
core::Vec3<T> plain_mirrored(const core::Vec3<T>& direction, const core::Vec3<T>& normal) {
  return direction - normal * (2 * dot(direction, normal));
}

/// Returns a point beside the surface, on the side to which the ray goes.
inline core::Vec3f plain_start(const PlainSurface& surface, const core::Vec3f& towards) {
  const float side = dot(towards, surface.geometric_normal) < 0 ? -plain_offset : plain_offset;
  return surface.point + surface.geometric_normal * side;
}

/// As above in double precision; doubles tell a curved surface from its ray, without an offset.
inline core::Vec3d plain_start(const PlainSurface& surface, const core::Vec3d& towards) {
  return surface.is_curved ? surface.exact_point : core::Vec3d(plain_start(surface, core::Vec3f(towards)));
}

/// Counts its rays, and nothing else. Not thread-safe; `stage` outlives it.
class EmbreeQueries {
 public:
  explicit EmbreeQueries(const PlainStage& stage) : stage_(stage) {}

  std::uint64_t rays() const { return rays_; }

 protected:
  const PlainStage& stage() const { return stage_; }
  /// Returns the nearest surface; nothing if the ray hits none.
  template <class T>
  std::optional<PlainSurface> surface_along(const core::Vec3<T>& origin, const core::Vec3<T>& direction);
  /// Returns the direct light that the surface, hit along `direction`, reflects, after a shadow ray to each light that may
  /// contribute.
  core::Color lights_on(const PlainSurface& surface, const PlainMaterial& material, const core::Vec3f& direction);
  /// As above; `shown(towards, scale, cosine)` returns the surface's response to light from `towards`, whose length is 1 /
  /// `scale` and whose cosine is above 0.
  template <class Shown>
  core::Color lights_on(const PlainSurface& surface, const Shown& shown);
  /// Returns whether nothing lies in that direction.
  bool is_free(const core::Vec3f& start, const core::Vec3f& direction);
  /// Returns whether something lies in front of `place` on an emitter.
  bool is_hidden(const core::Vec3f& start, const core::Vec3f& place);

 private:
  PlainSurface triangle_at(const RTCRayHit& asked, const core::Vec3f& origin, const core::Vec3f& direction) const;
  bool is_blocked(const core::Vec3f& start, const core::Vec3f& light);
  bool meets(RTCRay ray);

  const PlainStage& stage_;
  PlainContext context_;
  std::uint64_t rays_ = 0;
};

template <class Shown>
core::Color EmbreeQueries::lights_on(const PlainSurface& surface, const Shown& shown) {
  core::Color sum{};
  for (const core::LightRecord& light : stage_.lights()) {
    const core::Vec3f towards = light.position - surface.point;
    const float across = dot(towards, surface.normal);
    if (!(across > 0)) {
      continue;
    }
    const float scale = 1 / length(towards);
    const double share = core::share_of(light.spread, core::Vec3d(towards) * double{scale}, 1 / double{scale});
    const core::Color brought = light.intensity * shown(towards, scale, across * scale) * static_cast<float>(share);
    if (!(brought == core::Color{}) && !is_blocked(plain_start(surface, towards), light.position)) {
      sum = sum + brought;
    }
  }
  return sum;
}

}  // namespace dmpc::apps
