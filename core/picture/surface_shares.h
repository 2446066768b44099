// What of the light that a hit's rays find counts.
#pragma once

#include <algorithm>

#include "core/picture/hit_state.h"

namespace dmpc::core {

/// Of light found by a mirrored ray, in the brightest channel: what cannot be transmitted is reflected, too.
inline float mirrored_share(const HitState& state) {
  const MaterialRecord& material = state.surface.material;
  return material.specular * state.gloss().mirror + (state.has_refraction ? 0.0F : material.transmittance);
}

/// The same in each channel, over that.
inline Color mirrored_tint(const HitState& state) {
  const MaterialRecord& material = state.surface.material;
  const HitState::Gloss gloss = state.gloss();
  const float mirrored = material.specular * gloss.mirror, total = state.has_refraction ? 0.0F : material.transmittance;
  const float all = mirrored + total;
  return all > 0.0F ? Color{(gloss.tint.x * mirrored + total) / all, (gloss.tint.y * mirrored + total) / all,
                            (gloss.tint.z * mirrored + total) / all}
                    : Color{1, 1, 1};
}

/// The largest channel, at least 0.
template <class T>
T brightest(const Vec3<T>& color) {
  return std::max({color.x, color.y, color.z, T(0)});
}

}  // namespace dmpc::core
