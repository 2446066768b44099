#include "core/picture/microfacet_bound.h"

#include <algorithm>
#include <cmath>

#include "core/picture/microfacet.h"

namespace dmpc::core {
namespace {

/// What is between the cosines that are tried, and rounding.
constexpr double spare = 1.02;

/// By its brightest channel.
struct Surface {
  Surface(const Material& material, double texture_max)
      : facets(material.microfacets), color(largest_component(material.color) * texture_max) {
    const double dielectric = 1.0 - facets.metallic;
    straight = facets.reflectance * dielectric + color * facets.metallic;
    scattered = color * dielectric * (1.0 - facets.transmission) * (1.0 - facets.reflectance);
    through = largest_component(material.color) * dielectric * facets.transmission * (1.0 - facets.reflectance);
  }

  /// As a record has it.
  double alpha() const { return double{static_cast<float>(facets.roughness * facets.roughness)}; }
  double reflected(double cosine) const { return straight + std::max(1.0 - straight, 0.0) * schlick_share(cosine); }
  /// The most that a step along a ray at this cosine weighs: what it is chosen by, over how much less likely it is chosen than it
  /// may weigh.
  double weight_at(double cosine) const {
    const double chosen = reflected(cosine * (1.0 - 0.5 * alpha()));
    const double unlikely = alpha() < sharpest_alpha || !(chosen > 0.0) ? 1.0 : reflected(0.5 * cosine) / chosen;
    const double unreflected = 1.0 - schlick_share(cosine);
    return ((scattered + through) * unreflected + chosen) * std::max(over_mean_unreflected, unlikely);
  }

  Microfacets facets;
  double color, straight, scattered, through;
};

/// No density of normals is above that straight ahead, and no visibility times a cosine above 1 / (2 alpha).
MicrofacetBound bound_of_one(const Material& material, double texture_max) {
  constexpr int cosines = 64;
  const Surface surface(material, texture_max);
  const double alpha = surface.alpha();
  MicrofacetBound bound{.direct = surface.scattered * over_mean_unreflected};
  if (alpha >= sharpest_alpha) {
    bound.direct += surface.reflected(0.0) / (2.0 * alpha * alpha * alpha);
  }
  for (int i = 0; i <= cosines; ++i) {
    bound.passed_on = std::max(bound.passed_on, surface.weight_at(static_cast<double>(i) / cosines) * spare);
  }
  bound.passed_on = std::max(bound.passed_on, 1.0);
  return bound;
}

}  // namespace

/// Of a texture the bound of all surfaces that lie between the extremes of its metal and its roughness.
MicrofacetBound bound_of(const Material& material, double texture_max, const Texture* facets) {
  if (facets == nullptr) {
    return bound_of_one(material, texture_max);
  }
  constexpr int steps = 8;
  const auto between = [](double most, float least, int step) {
    return most * (double{least} + (1.0 - double{least}) * step / steps);
  };
  // The smoothest that is no mirror yet shows most of a point light.
  const double least = std::min(material.microfacets.roughness, std::sqrt(sharpest_alpha) * (1 + 0x1p-20));
  MicrofacetBound bound;
  Material one = material;
  for (int i = 0; i <= steps; ++i) {
    one.microfacets.metallic = between(material.microfacets.metallic, facets->darkest.z, i);
    for (int j = 0; j <= steps; ++j) {
      one.microfacets.roughness = std::max(least, between(material.microfacets.roughness, facets->darkest.y, j));
      const MicrofacetBound its = bound_of_one(one, texture_max);
      bound = {std::max(bound.direct, its.direct), std::max(bound.passed_on, its.passed_on)};
    }
  }
  return bound;
}

double sent_on_straight(const Material& material) {
  const Surface surface(material, 1.0);
  const double opacity = surface.facets.opacity;
  return opacity * (surface.scattered + surface.through + surface.straight) + (1.0 - opacity);
}

}  // namespace dmpc::core
