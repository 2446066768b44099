#include "apps/lab/bench/speed/plain_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/lab/bench/speed/plain_asker.h"
#include "core/picture/microfacet.h"
#include "core/picture/path_step.h"
#include "core/picture/sample_pair.h"
#include "core/picture/surface_response.h"

namespace dmpc::apps {

namespace {

using core::brightest;
using core::Color;
using core::Vec3f;

constexpr float inv_pi = std::numbers::inv_pi_v<float>;

Color white(float share) { return {share, share, share}; }

float schlick(float cosine) {
  const float less = 1 - cosine, square = less * less;
  return square * square * less;
}

/// Twice what Smith's function makes of a cosine, less that.
float roughened(float alpha, float cosine) { return std::sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine); }

/// How many tiny mirrors have normals at this cosine (GGX).
float mirrors_at(float alpha, float cosine) {
  const float square = alpha * alpha, spread = 1 - cosine * cosine * (1 - square);
  return square * inv_pi / (spread * spread);
}

}  // namespace

PlainLobes::PlainLobes(const PlainMaterial& material, const PlainSurface& surface, const Vec3f& direction)
    : material_(material),
      surface_(surface),
      direction_(direction),
      out_(-direction),
      cosine_(-dot(direction, surface.normal)),
      index_(surface.is_leaving ? material.inside_index() : 1 / material.inside_index()),
      behind_(1 - index_ * index_ * (1 - cosine_ * cosine_)),
      is_total_(index_ > 1 && behind_ < 0) {
  material.has_microfacets() ? begin_facets() : begin_plain();
}

void PlainLobes::begin_plain() {
  matt_ = material_.color * material_.diffuse;
  mirror_ = material_.highlight * material_.mirror + white(is_total_ ? material_.transmittance : 0);
  scattered_ = brightest(material_.color) * material_.diffuse;
  mirrored_ = brightest(mirror_);
  through_ = is_total_ ? 0 : material_.transmittance;
}

void PlainLobes::begin_facets() {
  if (cosine_ < 0) {
    out_ = out_ - surface_.normal * (2 * dot(out_, surface_.normal));
    cosine_ = -cosine_;
  }
  cosine_ = std::min(cosine_, 1.0F);
  const PlainFacets& facets = material_.facets;
  const float absent = 1 - facets.there;
  straight_ = (material_.color * facets.metallic + white(facets.reflectance * (1 - facets.metallic))) * facets.there;
  matt_ = material_.color * (material_.diffuse * (1 - facets.reflectance) * unreflected(cosine_));
  mirror_ = mirrored_share(cosine_);
  scattered_ = brightest(matt_);
  mirrored_ = brightest(is_spread() ? mirrored_share(cosine_ * (1 - 0.5F * facets.alpha)) : mirror_);
  through_ = std::min(material_.transmittance, absent) +
             std::max(material_.transmittance - absent, 0.0F) * (1 - facets.reflectance) * unreflected(cosine_);
}

bool PlainLobes::is_spread() const {
  return material_.has_microfacets() && material_.facets.alpha >= static_cast<float>(core::sharpest_alpha);
}

/// On the side where angles are wider.
float PlainLobes::unreflected(float cosine) const {
  return 1 - schlick(index_ > 1 ? std::sqrt(std::max(0.0F, 1 - index_ * index_ * (1 - cosine * cosine))) : cosine);
}

Color PlainLobes::mirrored_share(float cosine) const {
  return straight_ + (white(material_.facets.there) - straight_) * (1 - unreflected(cosine));
}

PlainLobes::Response PlainLobes::response(const Vec3f& in) const {
  const float cosine = std::min(dot(in, surface_.normal), 1.0F), side = surface_.is_leaving ? -1.0F : 1.0F;
  if (!(cosine > 0) || !(side * dot(in, surface_.geometric_normal) > 0) || !(all() > 0)) {
    return {};
  }
  const float lambert = cosine * inv_pi;
  if (!material_.has_microfacets()) {
    return {matt_ * lambert, scattered_ / all() * lambert};
  }
  Response found{matt_ * (unreflected(cosine) * static_cast<float>(core::over_mean_unreflected) * lambert), scattered_ * lambert};
  if (is_spread()) {
    const Vec3f half = normalize(in + out_);
    const float alpha = material_.facets.alpha, there = mirrors_at(alpha, std::min(dot(half, surface_.normal), 1.0F));
    const float rough_in = roughened(alpha, cosine), rough_out = roughened(alpha, cosine_);
    const float seen = 0.5F * cosine / (cosine * rough_out + cosine_ * rough_in);
    found.value = found.value + mirrored_share(std::min(dot(half, in), 1.0F)) * (there * seen);
    found.density += mirrored_ * there / (2 * (cosine_ + rough_out));
  }
  found.density /= all();
  return found;
}

std::optional<PlainWay> PlainLobes::way(const core::SamplePair& choice, const core::SamplePair& direction) const {
  const float place = static_cast<float>(choice.x) * all();
  if (place < scattered_) {
    return spread(Vec3f(core::cosine_direction(direction, core::Vec3d(surface_.normal))));
  }
  if (place < scattered_ + mirrored_) {
    return is_spread()
               ? spread(tiny_mirrored(direction))
               : std::optional(PlainWay{normalize(plain_mirrored(direction_, surface_.normal)), mirror_ * (all() / mirrored_)});
  }
  return through_ > 0 ? std::optional(PlainWay{normalize(bent()), white(all())}) : std::nullopt;
}

/// By whichever of both the direction was found, it counts for both.
std::optional<PlainWay> PlainLobes::spread(const Vec3f& in) const {
  const Response there = response(in);
  return there.density > 0 ? std::optional(PlainWay{in, there.value * (1 / there.density), true, there.density}) : std::nullopt;
}

/// By a normal that is seen, as Heitz (2018) draws it.
Vec3f PlainLobes::tiny_mirrored(const core::SamplePair& direction) const {
  const Vec3f& normal = surface_.normal;
  const float alpha = material_.facets.alpha;
  const Vec3f beside = out_ - normal * cosine_;
  const float slant = length(beside);
  const Vec3f first = slant > 0 ? beside * (1 / slant) : Vec3f(core::about_axis(core::Vec3d(normal), 1, 0, 0));
  const float size = std::sqrt(alpha * alpha * slant * slant + cosine_ * cosine_);
  const float sine = alpha * slant / size, cosine = cosine_ / size, lower = 0.5F * (1 + cosine);
  const core::DiscPlace disc = core::on_disc(direction);
  const auto x = static_cast<float>(disc.x);
  const float y = (1 - lower) * std::sqrt(std::max(0.0F, 1 - x * x)) + lower * static_cast<float>(disc.y);
  const float ahead = std::sqrt(std::max(0.0F, 1 - x * x - y * y));
  const Vec3f mirror = normalize(first * (alpha * (ahead * sine - y * cosine)) + cross(normal, first) * (alpha * x) +
                                 normal * std::max(0.0F, ahead * cosine + y * sine));
  return normalize(mirror * (2 * dot(mirror, out_)) - out_);
}

Vec3f PlainLobes::bent() const {
  return is_total_ ? plain_mirrored(direction_, surface_.normal)
                   : direction_ * index_ +
                         surface_.normal * (index_ * -dot(direction_, surface_.normal) - std::sqrt(std::max(behind_, 0.0F)));
}

}  // namespace dmpc::apps
