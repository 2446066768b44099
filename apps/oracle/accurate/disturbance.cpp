#include "apps/oracle/accurate/disturbance.h"

#include <algorithm>

#include "core/base/sampling.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr double float_rounding = 0x1p-24;
/// The product counts shares of levels and of probes in steps of half of this.
constexpr double share_rounding = 0x1p-15;
/// What the product's secondary rays start off their surface by, grid-local.
constexpr double surface_offset = 0x1p-21;

/// Of the triangle or the cone, whose normal turns where an end of it is moved.
double height_of(const AccurateBody& body) {
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

void Disturbance::shoot(AccurateRay& ray) {
  const Vec3d end = ray.origin + ray.direction * ray.t_max;
  ray.origin = ray.origin + random_vector() * (float_rounding * unit_);
  if (ray.kind != core::RayKind::primary) {
    const double side = dot(ray.direction, normal_) < 0 ? -1 : 1;
    ray.origin = ray.origin + normal_ * (side * surface_offset * unit_ * (0.75 + random() / 4));
  }
  // A shadow ray is aimed from where it starts.
  const Vec3d direction = ray.kind == core::RayKind::shadow ? normalize(end - ray.origin) : ray.direction;
  ray.direction = normalize(direction + random_vector() * (4 * float_rounding));
}

void Disturbance::touch(const AccurateRay& ray, const AccurateBody& body, AccurateSurface& surface) {
  const AccurateRay shifted{.origin = ray.origin + random_vector() * (float_rounding * unit_), .direction = ray.direction};
  const double before = dot(surface.point - ray.origin, ray.direction);
  const double t = distance_to(body, shifted).value_or(before);
  surface = surface_at(body, shifted, t + float_rounding * (t + unit_) * random());
  if (body.kind != core::PrimitiveKind::sphere) {
    surface.normal = normalize(surface.normal + random_vector() * (float_rounding * unit_ / height_of(body)));
  }
  normal_ = surface.normal;
}

void Disturbance::look_up(AccurateFootprint& footprint) {
  footprint.width *= 1 + share_rounding * random();
  footprint.strides = std::max(1.0, footprint.strides * (1 + share_rounding * random()));
}

}  // namespace dmpc::apps
