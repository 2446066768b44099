#include "core/picture/surfaces/microfacet_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/picture/hits/ray_start.h"
#include "core/picture/surfaces/microfacet.h"
#include "core/picture/surfaces/surface_response.h"

namespace dmpc::core {
namespace {

Vec3d white(double share) { return {share, share, share}; }

/// Mirrors the direction to the normal's side if necessary.
Vec3d raised(const Vec3d& direction, const Vec3d& normal) {
  const double height = dot(direction, normal);
  return height < 0.0 ? direction - normal * (2.0 * height) : direction;
}

/// Whether it is above both the blended normal and the true one.
bool is_above(const HitState& state, const Vec3d& in) { return dot(in, state.normal) > 0.0 && leads_outside(state, in); }

/// Covers the steps between the tested cosines, and rounding.
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

  /// As stored in a record.
  double alpha() const { return double{static_cast<float>(facets.roughness * facets.roughness)}; }
  double reflected(double cosine) const { return straight + std::max(1.0 - straight, 0.0) * schlick_share(cosine); }
  /// The maximum weight of a scattered ray at this cosine: the weight by which it is chosen, divided by the least ratio of its
  /// probability to that weight.
  double weight_at(double cosine) const {
    const double chosen = reflected(cosine * (1.0 - 0.5 * alpha()));
    const double unlikely = alpha() < sharpest_alpha || !(chosen > 0.0) ? 1.0 : reflected(0.5 * cosine) / chosen;
    const double unreflected = 1.0 - schlick_share(cosine);
    return ((scattered + through) * unreflected + chosen) * std::max(over_mean_unreflected, unlikely);
  }

  Microfacets facets;
  double color, straight, scattered, through;
};

/// The density of normals is greatest straight ahead, and visibility times a cosine is at most 1 / (2 alpha).
MicrofacetBound bound_of_one(const Material& material, double texture_max) {
  constexpr int cosines = 64;
  const Surface surface(material, texture_max);
  const double alpha = surface.alpha();
  const double index = material.refraction_index;
  const double crowding = material.transmittance > 0 && index > 1.0 ? index * index * spare : 1.0;
  MicrofacetBound bound{.direct = surface.scattered * over_mean_unreflected * crowding};
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

MicrofacetLobes::MicrofacetLobes(const HitState& state)
    : state_(state),
      facets_(state.microfacets()),
      out_(raised(-state.ray.full_direction(), state.normal)),
      cosine_(std::min(dot(out_, state.normal), 1.0)),
      index_(relative_index(state)) {
  const MaterialRecord& material = state.surface.material;
  const double metallic{facets_.metallic}, reflectance{facets_.reflectance}, there{facets_.there}, absent = 1.0 - there;
  const Vec3d base(material.color);
  straight_ = (base * metallic + white(reflectance * (1.0 - metallic))) * there;
  scattered_ = base * (double{material.diffuse} * (1.0 - reflectance));
  unreflected_ = 1.0 - share_at(cosine_);
  chances_.scattered = brightest(scattered_) * unreflected_;
  chances_.reflected = brightest(reflected_share(cosine_ * (is_mirror() ? 1.0 : 1.0 - 0.5 * double{facets_.alpha})));
  chances_.through = std::min(double{material.transmittance}, absent) +
                     std::max(double{material.transmittance} - absent, 0.0) * (1.0 - reflectance) * unreflected_;
}

bool MicrofacetLobes::is_mirror() const { return double{facets_.alpha} < sharpest_alpha; }

/// schlick_share() on the side with the wider angles, since reflection is equal from both.
double MicrofacetLobes::share_at(double cosine) const {
  if (index_ > 1.0) {
    cosine = std::sqrt(std::max(0.0, 1.0 - index_ * index_ * (1.0 - cosine * cosine)));
  }
  return schlick_share(cosine);
}

/// From within, the light that the diffuse layer outside scatters is refracted towards the normal, into the cone of the critical
/// angle: as much light in a smaller solid angle.
double MicrofacetLobes::crowding_at(double cosine) const {
  const double crowding = std::max(1.0, index_ * index_);
  return crowding * (1.0 - cosine * cosine) < 1.0 ? crowding : 0.0;
}

Vec3d MicrofacetLobes::matt_direction(const SamplePair& direction) const {
  const Vec3d& normal = state_.normal;
  const Vec3d outside = cosine_direction(direction, normal);
  if (!(index_ > 1.0)) {
    return outside;
  }
  const Vec3d across = (outside - normal * dot(outside, normal)) * (1.0 / index_);
  return across + normal * std::sqrt(std::max(0.0, 1.0 - dot(across, across)));
}

/// The mirror reflection at this cosine.
Vec3d MicrofacetLobes::reflected_share(double cosine) const {
  return straight_ + (white(double{facets_.there}) - straight_) * share_at(cosine);
}

Vec3d MicrofacetLobes::response(const Vec3d& in) const {
  if (!is_above(state_, in)) {
    return {};
  }
  const double cosine = std::min(dot(in, state_.normal), 1.0);
  const double coupling = unreflected_ * (1.0 - share_at(cosine)) * crowding_at(cosine);
  const Vec3d scattered = scattered_ * (coupling * over_mean_unreflected * std::numbers::inv_pi);
  if (is_mirror()) {
    return scattered * cosine;
  }
  const Vec3d half = normalize(in + out_);
  const double alpha{facets_.alpha};
  const double mirrors =
      normal_density(alpha, std::min(dot(half, state_.normal), 1.0)) * microfacet_visibility(alpha, cosine_, cosine);
  return (scattered + reflected_share(std::min(dot(half, in), 1.0)) * mirrors) * cosine;
}

double MicrofacetLobes::density(const Vec3d& in) const {
  if (!is_above(state_, in) || !(chances_.all() > 0.0)) {
    return 0.0;
  }
  const double cosine = dot(in, state_.normal);
  const double scattered = chances_.scattered * crowding_at(cosine) * cosine * std::numbers::inv_pi;
  const double half = std::min(dot(normalize(in + out_), state_.normal), 1.0);
  const double reflected = is_mirror() ? 0.0 : chances_.reflected * reflected_density(double{facets_.alpha}, cosine_, half);
  return (scattered + reflected) / chances_.all();
}

std::optional<PathStep> MicrofacetLobes::step(const SamplePair& choice, const SamplePair& direction) const {
  const double place = choice.x * chances_.all();
  if (place < chances_.scattered) {
    return spread_step(matt_direction(direction));
  }
  if (place < chances_.scattered + chances_.reflected) {
    return is_mirror() ? std::optional(mirror_step()) : spread_step(reflected_direction(direction));
  }
  return chances_.through > 0.0 ? std::optional(through_step()) : std::nullopt;
}

/// Combines both ways in which the direction could have been sampled.
std::optional<PathStep> MicrofacetLobes::spread_step(const Vec3d& in) const {
  const double likely = density(in);
  return likely > 0.0 ? std::optional(PathStep{in, Color(response(in) * (1.0 / likely)), RayKind::scattered, likely})
                      : std::nullopt;
}

PathStep MicrofacetLobes::mirror_step() const {
  const Vec3d towards = mirrored_direction(state_.ray.full_direction(), state_.normal);
  return {normalize(towards), Color(reflected_share(cosine_) * (chances_.all() / chances_.reflected)),
          kind_after(state_.ray, RayKind::reflected)};
}

/// Light that cannot be transmitted is mirrored.
PathStep MicrofacetLobes::through_step() const {
  const Vec3d direction = state_.ray.full_direction();
  const Vec3d towards =
      state_.has_refraction ? bent_direction(direction, state_.normal, index_) : mirrored_direction(direction, state_.normal);
  return {normalize(towards), Color(white(chances_.all())),
          kind_after(state_.ray, state_.has_refraction ? RayKind::refracted : RayKind::reflected)};
}

Vec3d MicrofacetLobes::reflected_direction(const SamplePair& direction) const {
  const Vec3d mirror = visible_normal(out_, state_.normal, double{facets_.alpha}, direction);
  return normalize(mirror * (2.0 * dot(mirror, out_)) - out_);
}

/// For a texture, the bound over all surfaces between the extremes of its metal and roughness.
MicrofacetBound bound_of(const Material& material, double texture_max, const Texture* facets) {
  if (facets == nullptr) {
    return bound_of_one(material, texture_max);
  }
  constexpr int steps = 8;
  const auto between = [](double most, float least, int step) {
    return most * (double{least} + (1.0 - double{least}) * step / steps);
  };
  // The smoothest surface that is not yet a mirror shows the brightest highlight of a point light.
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
