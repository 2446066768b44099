// What a hit's surface makes of light that comes from somewhere, and how likely its path goes on there: asked by those who aim at
// a light, and answered by the same arithmetic by which path_step() chooses its directions.
#pragma once

#include <algorithm>

#include "core/base/vec.h"
#include "core/picture/hits/hit_state.h"

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

/// The ways in which a surface sends light on, each in its brightest channel: a path takes one of them, in proportion to these.
struct WayShares {
  double scattered, mirrored, refracted;

  double all() const { return scattered + mirrored + refracted; }
};
WayShares shares_of(const HitState& state);

/// Of what comes to the diffuse part, by channels.
Color scattered_color(const HitState& state);

struct SurfaceResponse {
  /// What goes back along the ray where a radiance of 1 comes from there, per steradian, by channels: the scattering function
  /// times the cosine with the shading normal. What mirrors or lets through in one direction alone is none of it.
  Vec3d value;
  /// With which path_step() goes on there, per steradian, roulette apart: the sum over all ways that scatter of how likely each
  /// is taken times its density.
  double density = 0;
};

/// For light from the unit direction `towards`. All 0 where that leads into the surface, be it by the shading normal or by the
/// true one. Requires a hit of which all is known.
SurfaceResponse response_towards(const HitState& state, const Vec3d& towards);

/// Whether the value is above 0 from anywhere.
bool scatters(const HitState& state);

/// Whether a unit direction leads away from the surface, on the ray's side, by its true normal.
inline bool leads_outside(const HitState& state, const Vec3d& towards) {
  return (state.leaving ? -1.0 : 1.0) * dot(towards, state.geometric_normal) > 0.0;
}

}  // namespace dmpc::core
