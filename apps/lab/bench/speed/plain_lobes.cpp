#include "apps/lab/bench/speed/plain_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/lab/bench/speed/embree_queries.h"
#include "core/picture/surfaces/path_step.h"
#include "core/picture/surfaces/surface_response.h"

namespace dmpc::apps {

namespace {

using core::brightest;
using core::Color;
using core::Vec3f;

Color white(float share) { return {share, share, share}; }

FacetedPlace<float> faceted_place(const PlainMaterial& material, const PlainSurface& surface, const Vec3f& direction,
                                  float index) {
  const PlainFacets& facets = material.facets;
  const float absent = 1 - facets.there;
  return {.base = material.color,
          .metallic = facets.metallic,
          .alpha = facets.alpha,
          .reflectance = facets.reflectance,
          .there = facets.there,
          .matt = material.diffuse,
          .absent = std::min(material.transmittance, absent),
          .passing = std::max(material.transmittance - absent, 0.0F),
          .index = index,
          .direction = direction,
          .normal = surface.normal,
          .true_normal = surface.geometric_normal * (surface.is_leaving ? -1.0F : 1.0F)};
}

}  // namespace

PlainLobes::PlainLobes(const PlainMaterial& material, const PlainSurface& surface, const Vec3f& direction)
    : surface_(surface),
      direction_(direction),
      index_(surface.is_leaving ? material.inside_index() : 1 / material.inside_index()) {
  if (material.has_microfacets()) {
    facets_.emplace(faceted_place(material, surface, direction, index_));
    return;
  }
  const float cosine = dot(direction, surface.normal);
  behind_ = 1 - index_ * index_ * (1 - cosine * cosine);
  const bool is_total = index_ > 1 && behind_ < 0;
  matt_ = material.color * material.diffuse;
  mirror_ = material.highlight * material.mirror + white(is_total ? material.transmittance : 0);
  scattered_ = brightest(material.color) * material.diffuse;
  mirrored_ = brightest(mirror_);
  through_ = is_total ? 0 : material.transmittance;
}

PlainLobes::Response PlainLobes::response(const Vec3f& in) const {
  if (facets_) {
    return facets_->response(in);
  }
  const float cosine = std::min(dot(in, surface_.normal), 1.0F), side = surface_.is_leaving ? -1.0F : 1.0F;
  if (!(cosine > 0) || !(side * dot(in, surface_.geometric_normal) > 0) || !(all() > 0)) {
    return {};
  }
  const float lambert = cosine * std::numbers::inv_pi_v<float>;
  return {matt_ * lambert, scattered_ / all() * lambert};
}

std::optional<PlainWay> PlainLobes::way(const core::SamplePair& choice, const core::SamplePair& direction) const {
  if (facets_) {
    const auto step = facets_->step(choice, direction);
    return step ? std::optional(
                      PlainWay{normalize(step->towards), step->weight, step->kind == core::RayKind::scattered, step->density})
                : std::nullopt;
  }
  const float place = static_cast<float>(choice.x) * all();
  if (place < scattered_) {
    const Vec3f in(core::cosine_direction(direction, core::Vec3d(surface_.normal)));
    const Response there = response(in);
    return there.density > 0 ? std::optional(PlainWay{in, there.value * (1 / there.density), true, there.density}) : std::nullopt;
  }
  if (place < scattered_ + mirrored_) {
    return PlainWay{normalize(plain_mirrored(direction_, surface_.normal)), mirror_ * (all() / mirrored_)};
  }
  const Vec3f bent =
      direction_ * index_ + surface_.normal * (index_ * -dot(direction_, surface_.normal) - std::sqrt(std::max(behind_, 0.0F)));
  return through_ > 0 ? std::optional(PlainWay{normalize(bent), white(all())}) : std::nullopt;
}

}  // namespace dmpc::apps
