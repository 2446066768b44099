#include "core/picture/surfaces/surface_response.h"

#include <numbers>

#include "core/picture/surfaces/microfacet_lobes.h"

namespace dmpc::core {

Color scattered_color(const HitState& state) { return state.surface.material.color * state.surface.material.diffuse; }

WayShares shares_of(const HitState& state) {
  return {double{brightest(scattered_color(state))}, double{mirrored_share(state)},
          state.has_refraction ? double{state.surface.material.transmittance} : 0.0};
}

bool scatters(const HitState& state) {
  return state.has_microfacets() ? MicrofacetLobes(state).scatters() : shares_of(state).scattered > 0.0;
}

SurfaceResponse response_towards(const HitState& state, const Vec3d& towards) {
  if (state.has_microfacets()) {
    const MicrofacetLobes lobes(state);
    return {lobes.response(towards), lobes.density(towards)};
  }
  const double cosine = dot(towards, state.normal);
  if (!(cosine > 0.0) || !leads_outside(state, towards)) {
    return {};
  }
  const WayShares shares = shares_of(state);
  const double lambert = cosine * std::numbers::inv_pi;
  return {Vec3d(scattered_color(state)) * lambert, shares.scattered > 0.0 ? shares.scattered / shares.all() * lambert : 0.0};
}

}  // namespace dmpc::core
