// A thread of a plain renderer, which asks Embree for one ray at a time: surfaces, and what lights show on them.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/lab/bench/speed/plain_stage.h"
#include "core/base/vec.h"

namespace dmpc::apps {

inline core::Vec3f plain_mirrored(const core::Vec3f& direction, const core::Vec3f& normal) {
  return direction - normal * (2 * dot(direction, normal));
}

/// Beside the surface, on the side that a ray goes to.
inline core::Vec3f plain_start(const PlainSurface& surface, const core::Vec3f& towards) {
  const float side = dot(towards, surface.geometric_normal) < 0 ? -plain_offset : plain_offset;
  return surface.point + surface.geometric_normal * side;
}

/// Counts its rays, and nothing else. Not thread-safe; `stage` outlives it.
class EmbreeQueries {
 public:
  explicit EmbreeQueries(const PlainStage& stage) : stage_(stage) { embree::start(context_); }

  std::uint64_t rays() const { return rays_; }

 protected:
  const PlainStage& stage() const { return stage_; }
  /// The nearest; nothing if the ray meets none.
  std::optional<PlainSurface> surface_along(const core::Vec3f& origin, const core::Vec3f& direction);
  /// What lights show of the surface that a ray met along `direction`, after a shadow ray to each that may show something.
  core::Color lights_on(const PlainSurface& surface, const PlainMaterial& material, const core::Vec3f& direction);
  /// As above; `shown(towards, scale, cosine)` returns the surface's response to light from `towards`, whose length is 1 /
  /// `scale` and whose cosine is above 0.
  template <class Shown>
  core::Color lights_on(const PlainSurface& surface, const Shown& shown);
  /// Nothing lies that way.
  bool is_free(const core::Vec3f& start, const core::Vec3f& direction);
  /// Whether something lies before `place` on an emitter.
  bool is_hidden(const core::Vec3f& start, const core::Vec3f& place);

 private:
  PlainSurface triangle_at(const RTCRayHit& asked, const core::Vec3f& origin, const core::Vec3f& direction) const;
  bool is_blocked(const core::Vec3f& start, const core::Vec3f& light);
  bool meets(RTCRay ray);

  const PlainStage& stage_;
  embree::Context context_;
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
