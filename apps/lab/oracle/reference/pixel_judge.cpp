#include "apps/lab/oracle/reference/pixel_judge.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/picture/film/film.h"

namespace dmpc::apps {
namespace {

using core::RayKind;

constexpr std::array<std::string_view, pixel_cause_count> cause_names{
    "tie", "silhouette", "shadow silhouette", "ray end", "terminator", "critical angle", "rounding", "warned", "unexplained"};

/// Two distances are equal within this share of the farther one and of the grid-local unit: a few roundings of each.
constexpr double level = 64 * 0x1p-24;
/// A shadow ray's hit lies at its end if it is within this distance of its start, grid-local, or this share of its length before
/// its end.
constexpr double ray_end = 8e-6;

/// A ray's light is a product of at most two floats, one of them the rounded background.
constexpr double light_rounding = 4 * 0x1p-24;

PixelCause undecided(const LoggedRay& ray) {
  return ray.kind == RayKind::shadow ? PixelCause::terminator : PixelCause::critical_angle;
}

}  // namespace

std::string_view name_of(PixelCause cause) { return cause_names[static_cast<std::size_t>(cause)]; }

PixelJudge::PixelJudge(const core::Database& database, const core::RenderSettings& settings, const ReferenceScene& scene,
                       const ReferenceFinder& finder, const ReferenceCamera& camera, const core::RoundingLoss& loss)
    : logger_(database, settings, scene),
      audit_(database, settings.shade, scene, finder, std::max({loss.moved_pixels, loss.collapsed_pixels, loss.swapped_pixels})),
      options_(settings.shade),
      scene_(scene),
      finder_(finder),
      camera_(camera),
      unit_(1 / database.header().frame.scale) {}

Judgement PixelJudge::judge(std::uint32_t pixel, const core::Vec3d& radiance) const {
  const auto width = static_cast<std::uint32_t>(camera_.width());
  const ReferenceRay primary = camera_.ray_through(pixel % width, pixel / width);
  const ProductLog product = logger_.log_of(pixel);
  Audit audit = audit_.of(product, primary);
  if (audit.error.empty() && !is_light_of(product, audit, radiance)) {
    audit.error = "its light is not that of its rays";
  }
  const PixelCause cause = !audit.error.empty() ? PixelCause::unexplained
                           : audit.is_warned
                               ? PixelCause::warned
                               : cause_of_parting(product, reference_log_of_rays(scene_, finder_, options_, primary), audit);
  return {cause, audit.largest_step, audit.error};
}

/// The film rounds each ray's light to its own step.
bool PixelJudge::is_light_of(const ProductLog& product, const Audit& audit, const core::Vec3d& radiance) const {
  const core::Vec3d light = product.light(scene_.background) + audit.glow;
  const double steps = core::film_resolution / options_.film_scale.factor() * static_cast<double>(product.rays.size());
  const auto is_near = [&](std::size_t channel) {
    const double allowed = steps + light_rounding * std::fabs(light[channel]) + audit.glow_doubt[channel];
    return std::fabs(radiance[channel] - light[channel]) <= allowed;
  };
  return is_near(0) && is_near(1) && is_near(2);
}

PixelCause PixelJudge::cause_of_parting(const ProductLog& product, const RayLog& reference, const Audit& audit) const {
  for (std::size_t index = 0; index < product.rays.size(); ++index) {
    const LoggedRay& ray = product.rays[index];
    const LoggedRay* const other = reference.find(ray.path);
    if (other == nullptr) {
      return undecided(ray);
    }
    if (!ray.agrees_with(*other)) {
      return cause_of_answers(ray, *other, audit.doubts[index]);
    }
  }
  for (const LoggedRay& ray : reference.rays) {
    if (product.find(ray.path) == nullptr) {
      return undecided(ray);
    }
  }
  return PixelCause::rounding;
}

PixelCause PixelJudge::cause_of_answers(const LoggedRay& product, const LoggedRay& reference,
                                        const std::optional<Verdict>& doubt) const {
  if (product.kind == RayKind::shadow) {
    const LoggedRay& hidden = product.hit ? product : reference;
    const bool at_end = hidden.t < ray_end * unit_ || hidden.t > hidden.t_max * (1 - ray_end);
    return at_end || doubt == Verdict::end ? PixelCause::ray_end : PixelCause::shadow_silhouette;
  }
  const bool is_level = product.hit && reference.hit && std::fabs(product.t - reference.t) <= level * (reference.t + unit_);
  return is_level || doubt == Verdict::tie ? PixelCause::tie : PixelCause::silhouette;
}

}  // namespace dmpc::apps
