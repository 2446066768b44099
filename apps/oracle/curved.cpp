#include "apps/oracle/curved.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/expect.h"
#include "core/record/curved_values.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

/// Without the root of an eye that lies on the surface, as far as rounding may have moved that: it sees what lies around it
/// (core::is_on_surface()). `c`: of the quadratic; `size`: the largest coordinate and radius.
std::array<double, 2> without_start(std::array<double, 2> candidates, const core::Ray& ray, const core::CurvedValues& value,
                                    double c, double size, double radius) {
  if (ray.kind == core::RayKind::primary && core::is_on_surface(value, c, radius, size)) {
    const bool is_first = std::fabs(candidates[0]) < std::fabs(candidates[1]);
    candidates[is_first ? 0 : 1] = std::numeric_limits<double>::quiet_NaN();
  }
  return candidates;
}

std::optional<double> nearest_on_sphere(const core::CurvedValues& value, const core::Ray& ray) {
  const Vec3d center = value.vector(0);
  const double radius = value.value(3);
  const Vec3d direction = ray.full_direction();
  const Vec3d from_center = ray.full_origin() - center;
  const double a = dot(direction, direction);
  const double b = dot(from_center, direction);
  // The squared distance of centre and line is taken from its own vector: b^2 - a c would cancel for a far, small sphere.
  const Vec3d across = from_center - direction * (b / a);
  const double distance = length(from_center);
  const double c = (distance - std::fabs(radius)) * (distance + std::fabs(radius));
  const std::array<double, 2> both = quadratic_roots(a, b, c, a * (radius * radius - dot(across, across)));
  return first_root(without_start(both, ray, value, c, largest_component(center) + std::fabs(radius), radius), 0,
                    double{ray.t_max}, [&](double t) { return radius > 0 || dot(from_center + direction * t, direction) > 0; });
}

std::optional<double> nearest_on_cone(const core::CurvedValues& value, const core::Ray& ray) {
  const ConeAxis cone(value.vector(0), value.axis(), std::fabs(value.value(3)), std::fabs(value.value(7)));
  const Vec3d direction = ray.full_direction();
  const double along_direction = dot(direction, cone.axis);
  // A thin one all but lies in the plane of its base: only from there on its two sheets can be told apart.
  const double widest = std::max(cone.base_radius, std::fabs(cone.base_radius + cone.slope * cone.height));
  const bool is_thin = cone.height < std::fabs(along_direction) * widest * 0x1p-6;
  const double start = is_thin ? dot(cone.base - ray.full_origin(), cone.axis) / along_direction : 0;
  const Vec3d from_base = ray.full_origin() + direction * start - cone.base;
  const double along_origin = dot(from_base, cone.axis);
  const Vec3d across_origin = from_base - cone.axis * along_origin;
  const Vec3d across_direction = direction - cone.axis * along_direction;
  const double radius_origin = cone.base_radius + cone.slope * along_origin;
  const double radius_direction = cone.slope * along_direction;
  const double a = dot(across_direction, across_direction) - radius_direction * radius_direction;
  const double b = dot(across_origin, across_direction) - radius_origin * radius_direction;
  const double across_length = length(across_origin);
  const double c = (across_length - radius_origin) * (across_length + radius_origin);
  return first_root(quadratic_roots(a, b, c, b * b - a * c), start, double{ray.t_max}, [&](double t) {
    const double along = along_origin + t * along_direction;
    const double turn = dot(across_origin + across_direction * t, direction) -
                        cone.slope * (radius_origin + t * radius_direction) * along_direction;
    return along >= 0 && along <= cone.height && (!value.is_inside_visible_only() || turn > 0);
  });
}

/// Grows [center - radius, center + radius] by a few units in the last place, so that rounding never cuts into the body.
void enclose(std::array<float, 6>& box, const Vec3d& center, double radius) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double middle = center[axis], reach = std::fabs(radius);
    const double slack = (std::fabs(middle) + reach) * 0x1p-21;
    box[axis] = std::min(box[axis], static_cast<float>(middle - reach - slack));
    box[axis + 3] = std::max(box[axis + 3], static_cast<float>(middle + reach + slack));
  }
}

}  // namespace

std::array<double, 2> quadratic_roots(double a, double b, double c, double quarter) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!(quarter >= 0)) {
    return {none, none};
  }
  const double q = b > 0 ? -b - std::sqrt(quarter) : std::sqrt(quarter) - b;
  const double one = a != 0 ? q / a : none, other = q != 0 ? c / q : one;
  return one > other ? std::array{other, one} : std::array{one, other};
}

std::optional<double> nearest_on_curved(const core::PrimitiveValues& values, const core::Ray& ray) {
  core::expect(values.kind != core::PrimitiveKind::triangle, "a curved primitive is a sphere or a cone");
  const core::CurvedValues exact = values.curved();
  return values.kind == core::PrimitiveKind::sphere ? nearest_on_sphere(exact, ray) : nearest_on_cone(exact, ray);
}

std::array<float, 6> bounds_of_curved(const core::PrimitiveValues& values) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<float, 6> box{infinity, infinity, infinity, -infinity, -infinity, -infinity};
  const core::CurvedValues exact = values.curved();
  enclose(box, exact.vector(0), exact.value(3));
  if (values.kind == core::PrimitiveKind::cone) {
    enclose(box, exact.apex(), exact.value(7));
  }
  return box;
}

}  // namespace dmpc::apps
