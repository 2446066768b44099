#include "apps/lab/oracle/reference/disturbance.h"

#include <algorithm>
#include <cmath>

#include "core/base/sampling.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

/// The product counts shares of levels and of probes in steps of half of this.
constexpr double share_rounding = 0x1p-15;
/// Relative error of rounding a value with its rest, and a ray with its rest.
constexpr double curved_rounding = 0x1p-32;
constexpr double rest_rounding = 0x1p-45;
/// Offset of the product's secondary rays from their surface, grid-local, and its multiple along their way.
constexpr double clearance = 0x1p-20, tie_clearance = 0x1p-23, clearances_along = 8;

/// Returns the height of the triangle or the cone, whose normal turns if one of its ends is moved.
double height_of(const ReferenceBody& body) {
  const Vec3d a = body.place[1] - body.place[0], b = body.place[2] - body.place[0];
  return body.kind == core::PrimitiveKind::cone ? length(a)
                                                : length(cross(a, b)) / std::max({length(a), length(b), length(b - a)});
}

}  // namespace

double Disturbance::random() {
  state_ += 0x9e3779b97f4a7c15ULL;
  return static_cast<double>(core::mix(state_) >> 11U) * 0x1p-52 - 1;
}

Vec3d Disturbance::random_vector() {
  const double x = random(), y = random();
  return {x, y, random()};
}

void Disturbance::shoot(ReferenceRay& ray) {
  const Vec3d shift = random_vector() * (float_rounding * unit_), end = ray.origin + ray.direction * ray.t_max + shift;
  if (const double cosine = dot(ray.direction, normal_); ray.kind == core::RayKind::shadow && cosine != 0) {
    ray.weight = ray.weight * (1 + dot(shift, normal_) / (ray.t_max * cosine));
  }
  ray.origin = ray.origin + random_vector() * (rest_rounding * unit_);
  if (ray.kind != core::RayKind::primary) {
    const double cosine = dot(ray.direction, normal_), gap = clearance * size_ + tie_clearance * t_;
    const double along = std::min(gap / std::fabs(cosine), gap * clearances_along);
    const double across = std::copysign(is_flat_ ? std::max(gap - along * std::fabs(cosine), 0.0) : 0.0, cosine);
    ray.origin = ray.origin + (ray.direction * along + normal_ * across) * (0.75 + random() / 4);
  }
  // A shadow ray is aimed from its start.
  const Vec3d direction = ray.kind == core::RayKind::shadow ? normalize(end - ray.origin) : ray.direction;
  const bool is_rounded = is_smooth_ || ray.kind == core::RayKind::refracted;
  ray.direction = normalize(direction + random_vector() * (is_rounded ? 4 * float_rounding : rest_rounding));
}

void Disturbance::touch(const ReferenceRay& ray, const ReferenceBody& body, ReferenceSurface& surface) {
  const double rounding = body.kind == core::PrimitiveKind::triangle ? float_rounding : curved_rounding;
  const ReferenceRay shifted{.origin = ray.origin + random_vector() * (rounding * unit_), .direction = ray.direction};
  const double before = dot(surface.point - ray.origin, ray.direction);
  const double t = distance_to(body, shifted).value_or(before);
  surface = surface_at(body, shifted, t + rounding * (t + unit_) * random());
  if (body.kind != core::PrimitiveKind::sphere) {
    surface.normal = normalize(surface.normal + random_vector() * (rounding * unit_ / height_of(body)));
  }
  if (body.kind == core::PrimitiveKind::triangle) {
    for (double& weight : surface.weight) {
      weight += rounding * unit_ / height_of(body) * random();
    }
  }
  normal_ = surface.normal;
  t_ = t;
  size_ = unit_ + std::fabs(body.radius[0]) + std::fabs(body.radius[1]);
  is_flat_ = body.kind == core::PrimitiveKind::triangle;
  is_smooth_ = body.is_smooth();
}

void Disturbance::look_up(ReferenceFootprint& footprint) {
  footprint.width *= 1 + share_rounding * random();
  footprint.strides = std::max(1.0, footprint.strides * (1 + share_rounding * random()));
}

}  // namespace dmpc::apps
