// A surface's reflection of light from a given direction, and the probability that a path continues there: used by light
// sampling, and computed with the arithmetic by which path_step() chooses its directions.
#pragma once

#include <algorithm>

#include "core/base/vec.h"
#include "core/picture/hits/hit_state.h"

namespace dmpc::core {

/// The share of a mirrored ray's light, in the brightest channel: what cannot be transmitted is reflected, too.
inline float mirrored_share(const HitState& state) {
  const MaterialRecord& material = state.surface.material;
  return material.specular * state.gloss().mirror + (state.has_refraction ? 0.0F : material.transmittance);
}

/// The share in each channel, relative to mirrored_share().
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

/// The components by which a surface sends light on, each in its brightest channel: a path takes one of them, in proportion.
struct WayShares {
  double scattered, mirrored, refracted;

  double all() const { return scattered + mirrored + refracted; }
};
WayShares shares_of(const HitState& state);

/// The colour of the diffuse part, by channels.
Color scattered_color(const HitState& state);

struct SurfaceResponse {
  /// Radiance that is scattered back along the ray for a radiance of 1 from there, per steradian, by channels: the scattering
  /// function times the cosine with the shading normal. Mirrors and transmission in one direction are not included.
  Vec3d value;
  /// The density with which path_step() continues there, per steradian, without roulette: the sum over all scattering components
  /// of probability times density.
  double density = 0;
};

/// For light from the unit direction `towards`. All 0 where that leads into the surface, by the shading normal or the true one.
/// Requires a hit whose surface is known.
SurfaceResponse response_towards(const HitState& state, const Vec3d& towards);

/// Whether the value is above 0 for some direction.
bool scatters(const HitState& state);

/// Whether a unit direction leads away from the surface, on the ray's side, by its true normal.
inline bool leads_outside(const HitState& state, const Vec3d& towards) {
  return (state.leaving ? -1.0 : 1.0) * dot(towards, state.geometric_normal) > 0.0;
}

}  // namespace dmpc::core
