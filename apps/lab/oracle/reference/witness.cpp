#include "apps/lab/oracle/reference/witness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dmpc::apps {
namespace {

using core::Vec3d;

/// Rays in a ring, and rings, each a quarter as wide as the one before: wide rings miss narrow things.
constexpr int ring_rays = 16, ring_count = 8;
constexpr double ring_ratio = 0.25;
/// The least cosine between a ray and the surface that it leaves; a ray that grazes it more starts off the surface.
constexpr double least_cosine = 0.01;

bool is_shadow(const ReferenceRay& ray) { return ray.kind == core::RayKind::shadow; }

}  // namespace

std::optional<Verdict> WitnessFinder::find(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach,
                                           double crossing) const {
  if (is_beside(ray, claimed, reach)) {
    return Verdict::silhouette;
  }
  if (is_shadow(ray)) {
    return is_at_end(ray, claimed, reach) ? std::optional(Verdict::end) : std::nullopt;
  }
  const bool is_tie = is_level(ray, claimed, reach) && is_beside(ray, claimed, crossing);
  return is_tie ? std::optional(Verdict::tie) : std::nullopt;
}

bool WitnessFinder::has(const ReferenceRay& ray, const ClaimedAnswer& claimed) const {
  if (is_shadow(ray)) {
    return finder_.any(ray).found() == claimed.hit;
  }
  const ReferenceHit hit = finder_.closest(ray);
  return hit.found() == claimed.hit && (!claimed.hit || hit.body == claimed.body);
}

ReferenceRay WitnessFinder::beside(const ReferenceRay& ray, const Vec3d& step) const {
  ReferenceRay moved = ray;
  double along = 0;
  if (ray.ignored_body != core::no_primitive) {
    const Vec3d normal = surface_at(scene_.bodies[ray.ignored_body], ray, 0).normal;
    const double cosine = dot(ray.direction, normal);
    along = dot(step, normal) / std::copysign(std::max(std::fabs(cosine), least_cosine), cosine);
  }
  moved.origin = ray.origin + step - ray.direction * along;
  return moved;
}

template <class Accept>
bool WitnessFinder::any_beside(const ReferenceRay& ray, double reach, const Accept& accept) const {
  const auto [right, up] = cone_about(ray.direction, 1);
  double width = reach;
  for (int ring = 0; ring < ring_count; ++ring, width *= ring_ratio) {
    for (int place = 0; place < ring_rays; ++place) {
      const double angle = 2 * std::numbers::pi * place / ring_rays;
      if (accept(beside(ray, (right * std::cos(angle) + up * std::sin(angle)) * width))) {
        return true;
      }
    }
  }
  return false;
}

bool WitnessFinder::is_beside(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach) const {
  return any_beside(ray, reach, [&](const ReferenceRay& other) { return has(other, claimed); });
}

bool WitnessFinder::is_met(const ReferenceRay& ray, const ReferenceHit& hit, double rounding, double reach) const {
  const ReferenceBody& body = scene_.bodies[hit.body];
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  const auto is_between = [&](const ReferenceRay& other) {
    const bool starts_there = other.ignored_body == hit.body;
    if (const std::optional<double> t = starts_there ? distance_across(body, other) : distance_to(body, other)) {
      nearest = std::min(nearest, *t), farthest = std::max(farthest, *t);
    }
    return nearest - rounding < hit.t && hit.t < farthest + rounding;
  };
  return is_between(ray) || any_beside(ray, reach, is_between);
}

bool WitnessFinder::is_at_end(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach) const {
  ReferenceRay shorter = ray, longer = ray;
  shorter.t_max -= reach;
  longer.t_max += reach;
  return (shorter.t_max > 0 && has(shorter, claimed)) || has(longer, claimed);
}

bool WitnessFinder::is_level(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach) const {
  const ReferenceHit exact = finder_.closest(ray);
  if (!claimed.hit || !exact.found() || claimed.body == core::no_primitive) {
    return false;
  }
  const std::optional<double> t = distance_to(scene_.bodies[claimed.body], ray);
  if (!t) {
    return false;
  }
  const Vec3d here = surface_at(scene_.bodies[exact.body], ray, exact.t).normal;
  const Vec3d there = surface_at(scene_.bodies[claimed.body], ray, *t).normal;
  const double cosine = std::max(std::fabs(dot(here, ray.direction)), std::fabs(dot(there, ray.direction)));
  return std::fabs(*t - exact.t) * cosine <= reach;
}

}  // namespace dmpc::apps
