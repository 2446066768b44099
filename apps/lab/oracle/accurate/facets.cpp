#include "apps/lab/oracle/accurate/facets.h"

#include <algorithm>
#include <cmath>

#include "core/picture/microfacet.h"
#include "core/picture/path_step.h"

namespace dmpc::apps {
namespace {

using core::RayKind;
using core::Vec3d;

const double half_turn = std::acos(-1.0);

double brightest_of(const Vec3d& color) { return std::max({color.x, color.y, color.z}); }
Vec3d grey(double share) { return {share, share, share}; }

}  // namespace

AccurateFacets::AccurateFacets(const FacetedPlace& place) : place_(place), out_(-place.direction) {
  const double height = dot(out_, place.normal);
  out_ = height < 0 ? out_ - place.normal * (2 * height) : out_;
  cosine_ = std::min(1.0, std::fabs(height));
  const core::Microfacets& facets = place.facets;
  const double dielectric = place.there * (1 - facets.metallic), unreflected = (1 - facets.reflectance) * (1 - fresnel(cosine_));
  const double mean = (place.base.x + place.base.y + place.base.z) / 3;
  scattered_ = brightest_of(place.base) * dielectric * (1 - facets.transmission) * unreflected;
  reflected_ = brightest_of(tinted(alpha() < core::sharpest_alpha ? cosine_ : cosine_ * (1 - alpha() / 2)));
  through_ = 1 - place.there + dielectric * facets.transmission * mean * unreflected;
  all_ = scattered_ + reflected_ + through_;
}

/// What a surface reflects beyond what it does straight ahead, over the most that can be; of light from within, by the angle
/// outside.
double AccurateFacets::fresnel(double cosine) const {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), outside = place_.index > 1 ? place_.index * sine : sine;
  return std::pow(1 - std::sqrt(std::max(0.0, 1 - outside * outside)), 5);
}

Vec3d AccurateFacets::tinted(double cosine) const {
  const core::Microfacets& facets = place_.facets;
  const Vec3d ahead = place_.base * facets.metallic + grey(facets.reflectance * (1 - facets.metallic));
  return (ahead + (grey(1) - ahead) * fresnel(cosine)) * place_.there;
}

/// Light that has gone in, and out again; Schlick's share is 1/21 on average.
Vec3d AccurateFacets::matt(double cosine) const {
  const core::Microfacets& facets = place_.facets;
  const double share = place_.there * (1 - facets.metallic) * (1 - facets.transmission) * (1 - facets.reflectance);
  return place_.base * (share * (1 - fresnel(cosine_)) * (1 - fresnel(cosine)) / (1 - 1.0 / 21));
}

bool AccurateFacets::is_above(const Vec3d& in) const { return dot(in, place_.normal) > 0 && dot(in, place_.true_normal) > 0; }

bool AccurateFacets::transmits() const {
  const double cosine = dot(place_.direction, place_.normal);
  return 1 - place_.index * place_.index * (1 - cosine * cosine) >= 0;
}

/// Lambda of Smith's function.
double AccurateFacets::smith(double cosine) const {
  const double slope = (1 - cosine * cosine) / (cosine * cosine);
  return (std::sqrt(1 + alpha() * alpha() * slope) - 1) / 2;
}

double AccurateFacets::normals_at(double cosine) const {
  const double square = cosine * cosine, spread = square + (1 - square) / (alpha() * alpha());
  return 1 / (half_turn * alpha() * alpha() * spread * spread);
}

Vec3d AccurateFacets::response(const Vec3d& in) const {
  if (!is_above(in)) {
    return {};
  }
  const double cosine = std::min(1.0, dot(in, place_.normal));
  Vec3d sum = matt(cosine);
  if (alpha() >= core::sharpest_alpha) {
    const Vec3d half = normalize(in + out_);
    const double unhidden = 1 / (1 + smith(cosine_) + smith(cosine));
    sum = sum + tinted(std::min(1.0, dot(half, out_))) *
                    (half_turn * normals_at(std::min(1.0, dot(half, place_.normal))) * unhidden / (4 * cosine_ * cosine));
  }
  return sum * cosine;
}

double AccurateFacets::density(const Vec3d& in) const {
  if (!is_above(in)) {
    return 0;
  }
  double sum = scattered_ * dot(in, place_.normal) / half_turn;
  if (alpha() >= core::sharpest_alpha) {
    const Vec3d half = normalize(in + out_);
    const double seen = dot(half, out_) / cosine_ / (1 + smith(cosine_));
    sum += reflected_ * seen * normals_at(std::min(1.0, dot(half, place_.normal))) / (4 * dot(half, out_));
  }
  return sum / all_;
}

std::optional<FacetedStep> AccurateFacets::spread(const Vec3d& in) const {
  return is_above(in) ? std::optional(FacetedStep{in, response(in) * (1 / (half_turn * density(in))), RayKind::scattered})
                      : std::nullopt;
}

std::optional<FacetedStep> AccurateFacets::step(const core::SamplePair& choice, const core::SamplePair& direction) const {
  const double place = choice.x * all_, down = dot(place_.direction, place_.normal);
  const Vec3d& normal = place_.normal;
  const Vec3d mirrored = place_.direction - normal * (2 * down);
  if (place < scattered_) {
    return spread(core::cosine_direction(direction, normal));
  }
  if (place < scattered_ + reflected_ && alpha() < core::sharpest_alpha) {
    return FacetedStep{mirrored, tinted(cosine_) * (all_ / reflected_), RayKind::reflected};
  }
  if (place < scattered_ + reflected_) {
    const Vec3d facet = core::visible_normal(out_, normal, alpha(), direction);
    return spread(facet * (2 * dot(facet, out_)) - out_);
  }
  if (!(through_ > 0)) {
    return std::nullopt;
  }
  const double behind = 1 - place_.index * place_.index * (1 - down * down);
  return transmits() ? FacetedStep{place_.direction * place_.index - normal * (place_.index * down + std::sqrt(behind)),
                                   grey(all_), RayKind::refracted}
                     : FacetedStep{mirrored, grey(all_), RayKind::reflected};
}

}  // namespace dmpc::apps
