// Microfacet surfaces, written anew from the definition, in single and in double precision: core's are measured against them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/base/vec.h"
#include "core/picture/sampling/sample_pair.h"
#include "core/picture/surfaces/microfacet.h"
#include "core/picture/surfaces/path_step.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// What is known of a hit on a microfacet surface. The normals lie on the ray's side.
template <class Real>
struct FacetedPlace {
  core::Vec3<Real> base;                          ///< the colour at the hit
  Real metallic = 0, alpha = 1, reflectance = 0;  ///< `reflectance`: of a dielectric at normal incidence
  Real there = 1;                                 ///< the share of the surface that is present, its opacity included
  Real matt = 0;                                  ///< the share of the entering light that is scattered
  Real absent = 0, passing = 0;  ///< shares of the light that passes the surface without reflection, and of the entering light
                                 ///< that is transmitted
  Real index = 1;                ///< ratio of refractive indices: the ray's side over the other side
  core::Vec3<Real> direction;    ///< the ray's
  core::Vec3<Real> normal, true_normal;  ///< `normal` is for shading
};

/// A direction in which a path continues; `kind` is that of the continuing ray.
template <class Real>
struct FacetedStep {
  core::Vec3<Real> towards, weight;
  core::RayKind kind{};
  Real density = std::numeric_limits<Real>::infinity();  ///< per steradian, of scattered light
};

template <class Real>
struct FacetedResponse {
  core::Vec3<Real> value;  ///< response to a radiance of 1 from that direction, per steradian, including the cosine
  Real density = 0;        ///< probability density of that direction
};

/// GGX with height-correlated Smith masking and Schlick's Fresnel, over a Lambertian that is coupled to a smooth surface.
/// Directions are chosen with the product's probabilities; of the product's maps only those to a disc and about an axis are used.
template <class Real>
class FacetLobes {
 public:
  using Vec = core::Vec3<Real>;

  explicit FacetLobes(const FacetedPlace<Real>& place)
      : place_(place), out_(-place.direction), cosine_(dot(out_, place.normal)), straight_(straight_of(place)) {
    if (cosine_ < 0) {
      out_ = out_ - place.normal * (2 * cosine_);
      cosine_ = -cosine_;
    }
    cosine_ = std::min(cosine_, Real{1});
    const Real in = (1 - place.reflectance) * unreflected(cosine_);
    matt_ = place.base * (place.matt * in);
    scattered_ = brightest_of(matt_);
    reflected_ = brightest_of(tinted(is_spread() ? cosine_ * (1 - place.alpha / 2) : cosine_));
    through_ = place.absent + place.passing * in;
    all_ = scattered_ + reflected_ + through_;
  }

  /// Returns whether paths continue in more than one direction.
  bool scatters() const { return scattered_ > 0 || (is_spread() && reflected_ > 0); }

  /// Returns the response to light from the unit direction `in`; nothing below either normal.
  FacetedResponse<Real> response(const Vec& in) const {
    const Real cosine = std::min(dot(in, place_.normal), Real{1});
    if (!(cosine > 0) || !(dot(in, place_.true_normal) > 0) || !(all_ > 0)) {
      return {};
    }
    const Real lambert = cosine * std::numbers::inv_pi_v<Real>;
    const Real matt = lambert * crowding(cosine);
    FacetedResponse<Real> found{matt_ * (unreflected(cosine) * matt * 21 / 20), scattered_ * matt};  // Schlick's mean is 1/21
    if (is_spread()) {
      const Vec half = normalize(in + out_);
      const Real mirrors = mirrors_at(std::min(dot(half, place_.normal), Real{1}));
      const Real rough_in = roughened(cosine), rough_out = roughened(cosine_);
      found.value = found.value + tinted(std::min(dot(half, in), Real{1})) *
                                      (mirrors * cosine / (2 * (cosine * rough_out + cosine_ * rough_in)));
      found.density += reflected_ * mirrors / (2 * (cosine_ + rough_out));
    }
    found.density /= all_;
    return found;
  }

  /// Chooses in proportion to the brightest channels of all lobes; returns nothing if no path continues.
  std::optional<FacetedStep<Real>> step(const core::SamplePair& choice, const core::SamplePair& direction) const {
    const Real place = static_cast<Real>(choice.x) * all_;
    if (place < scattered_) {
      return spread(below_surface(Vec(core::cosine_direction(direction, core::Vec3d(place_.normal)))));
    }
    if (place < scattered_ + reflected_) {
      return is_spread()
                 ? spread(mirrored_by_facet(direction))
                 : std::optional(FacetedStep<Real>{mirrored(), tinted(cosine_) * (all_ / reflected_), core::RayKind::reflected});
    }
    if (!(through_ > 0)) {
      return std::nullopt;
    }
    const Real down = dot(place_.direction, place_.normal), behind = 1 - place_.index * place_.index * (1 - down * down);
    return behind >= 0 || place_.index <= 1
               ? FacetedStep<Real>{place_.direction * place_.index -
                                       place_.normal * (place_.index * down + std::sqrt(std::max(behind, Real{0}))),
                                   grey(all_), core::RayKind::refracted}
               : FacetedStep<Real>{mirrored(), grey(all_), core::RayKind::reflected};
  }

 private:
  static Vec grey(Real share) { return {share, share, share}; }
  static Real brightest_of(const Vec& color) { return std::max({color.x, color.y, color.z}); }
  static Vec straight_of(const FacetedPlace<Real>& place) {
    return (place.base * place.metallic + grey(place.reflectance * (1 - place.metallic))) * place.there;
  }

  /// Whether the microfacets differ in direction.
  bool is_spread() const { return place_.alpha >= static_cast<Real>(core::sharpest_alpha); }
  /// The share of the light not reflected at normal incidence that enters, or leaves from within, at this angle outside.
  Real unreflected(Real cosine) const {
    const Real squared = 1 - place_.index * place_.index * (1 - cosine * cosine);
    const Real less = 1 - (place_.index > 1 ? std::sqrt(std::max(Real{0}, squared)) : cosine), square = less * less;
    return 1 - square * square * less;
  }
  /// Returns the concentration of the light that the matt layer sends inwards: refraction narrows its directions to a cone.
  Real crowding(Real cosine) const {
    const Real square = std::max(Real{1}, place_.index * place_.index);
    return square * (1 - cosine * cosine) < 1 ? square : Real{0};
  }
  /// Refracts a direction outside by Snell's law.
  Vec below_surface(const Vec& outside) const {
    if (!(place_.index > 1)) {
      return outside;
    }
    const Vec beside = (outside - place_.normal * dot(outside, place_.normal)) * (1 / place_.index);
    return beside + place_.normal * std::sqrt(std::max(Real{0}, 1 - dot(beside, beside)));
  }
  Vec tinted(Real cosine) const { return straight_ + (grey(place_.there) - straight_) * (1 - unreflected(cosine)); }
  Vec mirrored() const { return place_.direction - place_.normal * (2 * dot(place_.direction, place_.normal)); }

  /// Returns twice Smith's function of a cosine, less the cosine.
  Real roughened(Real cosine) const {
    const Real square = place_.alpha * place_.alpha;
    return std::sqrt(square + (1 - square) * cosine * cosine);
  }
  /// Returns the density of microfacets whose normals have this cosine.
  Real mirrors_at(Real cosine) const {
    const Real square = place_.alpha * place_.alpha, spread = 1 - cosine * cosine * (1 - square);
    return square * std::numbers::inv_pi_v<Real> / (spread * spread);
  }

  /// The direction may come from either lobe and counts for both.
  std::optional<FacetedStep<Real>> spread(const Vec& in) const {
    const FacetedResponse<Real> there = response(in);
    return there.density > 0
               ? std::optional(FacetedStep<Real>{in, there.value * (1 / there.density), core::RayKind::scattered, there.density})
               : std::nullopt;
  }

  /// Reflects at a visible normal, drawn as Heitz (2018) does.
  Vec mirrored_by_facet(const core::SamplePair& direction) const {
    const Vec& normal = place_.normal;
    const Real alpha = place_.alpha;
    const Vec beside = out_ - normal * cosine_;
    const Real slant = length(beside);
    const Vec first = slant > 0 ? beside * (1 / slant) : Vec(core::about_axis(core::Vec3d(normal), 1, 0, 0));
    const Real size = std::sqrt(alpha * alpha * slant * slant + cosine_ * cosine_);
    const Real sine = alpha * slant / size, cosine = cosine_ / size, lower = (1 + cosine) / 2;
    const core::DiscPlace disc = core::on_disc(direction);
    const auto x = static_cast<Real>(disc.x);
    const Real y = (1 - lower) * std::sqrt(std::max(Real{0}, 1 - x * x)) + lower * static_cast<Real>(disc.y);
    const Real ahead = std::sqrt(std::max(Real{0}, 1 - x * x - y * y));
    const Vec mirror = normalize(first * (alpha * (ahead * sine - y * cosine)) + cross(normal, first) * (alpha * x) +
                                 normal * std::max(Real{0}, ahead * cosine + y * sine));
    return normalize(mirror * (2 * dot(mirror, out_)) - out_);
  }

  FacetedPlace<Real> place_;
  Vec out_;  ///< the direction that the ray comes from, or one above the normal close to it
  Real cosine_;
  Vec straight_, matt_;
  Real scattered_ = 0, reflected_ = 0, through_ = 0, all_ = 0;  ///< weights of the directions, and their sum
};

}  // namespace dmpc::apps
