#include "apps/lab/oracle/reference/body.h"

#include <algorithm>
#include <cmath>

#include "apps/oracle/curved.h"

namespace dmpc::apps {
namespace {

using core::PrimitiveKind;
using core::Vec3d;

/// The product also leaves out primitives beyond it.
constexpr double coordinate_max = 1e30;

bool is_usable(const Vec3d& v) {
  return std::fabs(v.x) < coordinate_max && std::fabs(v.y) < coordinate_max && std::fabs(v.z) < coordinate_max;
}

double squared(const Vec3d& v) { return dot(v, v); }

/// Returns the volume of the ray's direction with an edge, as seen from the ray's origin. It is computed from the edge's middle,
/// so its error is at most relative to the ray's distance times the edge's length, which is small for a small, distant triangle.
/// Swapping the edge's ends changes only the sign, in floating point as well.
double volume(const ReferenceRay& ray, const Vec3d& from, const Vec3d& to) {
  return dot((from + to) * 0.5 - ray.origin, cross(to - from, ray.direction));
}

/// Returns the volumes with each corner's opposite edge.
std::array<double, 3> volumes(const ReferenceBody& body, const ReferenceRay& ray) {
  const auto& [a, b, c] = body.place;
  return {volume(ray, b, c), volume(ray, c, a), volume(ray, a, b)};
}

std::optional<double> to_triangle(const ReferenceBody& body, const ReferenceRay& ray) {
  const auto [a, b, c] = volumes(body, ray);
  if ((a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0)) {
    return std::nullopt;
  }
  const Vec3d normal = cross(body.place[1] - body.place[0], body.place[2] - body.place[0]);
  const double approach = dot(ray.direction, normal);
  if (approach == 0) {
    return std::nullopt;
  }
  const double t = dot(body.place[0] - ray.origin, normal) / approach;
  return t > 0 && t < ray.t_max ? std::optional(t) : std::nullopt;
}

ReferenceSurface on_triangle(const ReferenceBody& body, const ReferenceRay& ray) {
  ReferenceSurface surface;
  surface.weight = volumes(body, ray);
  const double sum = surface.weight[0] + surface.weight[1] + surface.weight[2];
  for (std::size_t k = 0; k < 3; ++k) {
    surface.weight[k] = sum != 0 ? std::clamp(surface.weight[k] / sum, 0.0, 1.0) : 1.0 / 3;
    surface.point = surface.point + body.place[k] * surface.weight[k];
  }
  surface.normal = normalize(cross(body.place[1] - body.place[0], body.place[2] - body.place[0]));
  return surface;
}

std::optional<double> to_sphere(const ReferenceBody& body, const ReferenceRay& ray) {
  const double radius = std::fabs(body.radius[0]);
  const double shift = dot(body.place[0] - ray.origin, ray.direction) / squared(ray.direction);
  const Vec3d nearest = ray.origin + ray.direction * shift - body.place[0];
  const double a = squared(ray.direction), b = dot(nearest, ray.direction), off = length(nearest);
  const double c = (off - radius) * (off + radius);
  return first_root(quadratic_roots(a, b, c, b * b - a * c), shift, ray.t_max,
                    [&](double root) { return body.radius[0] > 0 || root > 0; });
}

ConeAxis axis_of(const ReferenceBody& body) {
  return {body.place[0], body.place[1] - body.place[0], std::fabs(body.radius[0]), std::fabs(body.radius[1])};
}

constexpr double thin_share = 0.01;

std::optional<double> to_cone(const ReferenceBody& body, const ReferenceRay& ray) {
  const ConeAxis cone = axis_of(body);
  const Vec3d middle = cone.base + cone.axis * (cone.height / 2);
  const double rise = dot(ray.direction, cone.axis), widest = std::max(cone.base_radius, std::fabs(body.radius[1]));
  // A thin cone almost lies in a plane. Away from the point at which the ray crosses that plane, doubles could not distinguish
  // its two sheets.
  const bool is_crossed = cone.height < thin_share * std::fabs(rise) * widest;
  const double shift =
      is_crossed ? dot(middle - ray.origin, cone.axis) / rise : dot(middle - ray.origin, ray.direction) / squared(ray.direction);
  const Vec3d start = ray.origin + ray.direction * shift - cone.base;
  const double up = is_crossed ? cone.height / 2 : dot(start, cone.axis);
  const Vec3d off = start - cone.axis * up, going = ray.direction - cone.axis * rise;
  const double radius = cone.base_radius + cone.slope * up, widening = cone.slope * rise;
  const double a = squared(going) - widening * widening, b = dot(off, going) - radius * widening;
  const double c = (length(off) - radius) * (length(off) + radius);
  const bool inside_only = body.radius[0] < 0 || body.radius[1] < 0;
  return first_root(quadratic_roots(a, b, c, b * b - a * c), shift, ray.t_max, [&](double root) {
    const double at = up + rise * root;
    const double leaving = dot(off + going * root, going) - (radius + widening * root) * widening;
    return at >= 0 && at <= cone.height && (!inside_only || leaving > 0);
  });
}

ReferenceSurface on_sphere(const ReferenceBody& body, const Vec3d& point) {
  const Vec3d outward = normalize(point - body.place[0]);
  return {.point = body.place[0] + outward * std::fabs(body.radius[0]), .normal = outward};
}

ReferenceSurface on_cone(const ReferenceBody& body, const Vec3d& point) {
  const ConeAxis cone = axis_of(body);
  const double up = std::clamp(dot(point - cone.base, cone.axis), 0.0, cone.height);
  const Vec3d off = point - cone.base - cone.axis * up;
  const double distance = length(off);
  const Vec3d radial = distance > 0 ? off * (1 / distance) : Vec3d{};
  return {.point = cone.base + cone.axis * up + radial * (cone.base_radius + cone.slope * up),
          .normal = normalize(radial - cone.axis * cone.slope)};
}

}  // namespace

bool is_usable(const ReferenceBody& body) {
  const auto& place = body.place;
  switch (body.kind) {
    case PrimitiveKind::triangle:
      return is_usable(place[0]) && is_usable(place[1]) && is_usable(place[2]) &&
             squared(cross(place[1] - place[0], place[2] - place[0])) > 0;
    case PrimitiveKind::sphere:
      return is_usable(place[0]) && body.radius[0] != 0 && std::fabs(body.radius[0]) < coordinate_max;
    case PrimitiveKind::cone:
    case PrimitiveKind::instance:  // is no primitive
      break;
  }
  return is_usable(place[0]) && is_usable(place[1]) && place[0] != place[1] && (body.radius[0] != 0 || body.radius[1] != 0) &&
         std::fabs(body.radius[0]) < coordinate_max && std::fabs(body.radius[1]) < coordinate_max;
}

namespace {

/// Returns the other root, once one is the ray's start.
std::optional<double> if_ahead(double other, const ReferenceRay& ray) {
  return other > 0 && other < ray.t_max ? std::optional(other) : std::nullopt;
}

std::optional<double> across_sphere(const ReferenceBody& body, const ReferenceRay& ray) {
  return if_ahead(2 * dot(body.place[0] - ray.origin, ray.direction) / squared(ray.direction), ray);
}

std::optional<double> across_cone(const ReferenceBody& body, const ReferenceRay& ray) {
  const ConeAxis cone = axis_of(body);
  const Vec3d start = ray.origin - cone.base;
  const double up = dot(start, cone.axis), rise = dot(ray.direction, cone.axis), widening = cone.slope * rise;
  const Vec3d off = start - cone.axis * up, going = ray.direction - cone.axis * rise;
  const double b = dot(off, going) - (cone.base_radius + cone.slope * up) * widening;
  const std::optional<double> t = if_ahead(-2 * b / (squared(going) - widening * widening), ray);
  const double at = t ? up + rise * *t : -1;
  const bool is_inside_only = body.radius[0] < 0 || body.radius[1] < 0;
  return at >= 0 && at <= cone.height && (!is_inside_only || b < 0) ? t : std::nullopt;
}

}  // namespace

std::optional<double> distance_across(const ReferenceBody& body, const ReferenceRay& ray) {
  return body.kind == PrimitiveKind::triangle ? std::nullopt
         : body.kind == PrimitiveKind::sphere ? across_sphere(body, ray)
                                              : across_cone(body, ray);
}

std::optional<double> distance_to(const ReferenceBody& body, const ReferenceRay& ray) {
  return body.kind == PrimitiveKind::triangle ? to_triangle(body, ray)
         : body.kind == PrimitiveKind::sphere ? to_sphere(body, ray)
                                              : to_cone(body, ray);
}

ReferenceSurface surface_at(const ReferenceBody& body, const ReferenceRay& ray, double t) {
  const Vec3d point = ray.origin + ray.direction * t;
  return body.kind == PrimitiveKind::triangle ? on_triangle(body, ray)
         : body.kind == PrimitiveKind::sphere ? on_sphere(body, point)
                                              : on_cone(body, point);
}

core::Box bounds_of(const ReferenceBody& body) {
  core::Box box;
  const std::size_t places = body.kind == PrimitiveKind::triangle ? 3 : body.kind == PrimitiveKind::sphere ? 1 : 2;
  for (std::size_t k = 0; k < places; ++k) {
    const double reach = places == 3 ? 0.0 : std::fabs(body.radius[k]);
    box.include(body.place[k] - Vec3d{reach, reach, reach});
    box.include(body.place[k] + Vec3d{reach, reach, reach});
  }
  return box;
}

}  // namespace dmpc::apps
