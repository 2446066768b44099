#include "core/trace/primitive.h"

#include <algorithm>
#include <cmath>

#include "core/base/mutation.h"

namespace dmpc::core {
namespace {

std::uint32_t largest_axis(const Vec3f& d) {
  const float x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
  return x > y ? (x > z ? 0U : 2U) : (y > z ? 1U : 2U);
}

/// One vertex of a triangle in the sheared frame; z is not scaled yet.
struct ShearedVertex {
  float x, y, z;

  ShearedVertex(const ShearedRay& ray, const float* vertex, std::size_t stride) {
    z = vertex[ray.axis_z * stride] - ray.origin[ray.axis_z];
    x = std::fma(-ray.shear_x, z, vertex[ray.axis_x * stride] - ray.origin[ray.axis_x]);
    y = std::fma(-ray.shear_y, z, vertex[ray.axis_y * stride] - ray.origin[ray.axis_y]);
  }
};

float edge(const ShearedVertex& a, const ShearedVertex& b) {
  if constexpr (mutation == Mutation::contracted_edges) {
    return std::fma(a.x, b.y, -(a.y * b.x));
  }
  return a.x * b.y - a.y * b.x;
}

/// Products of floats are exact in double, so the sign of the difference is.
float exact_edge(const ShearedVertex& a, const ShearedVertex& b) {
  return static_cast<float>(double{a.x} * double{b.y} - double{a.y} * double{b.x});
}

/// Whether the edge functions differ in sign; zeros are on either side, so an edge belongs to both its triangles.
bool outside(float u, float v, float w) {
  if constexpr (mutation == Mutation::exclusive_edges) {
    return (u <= 0.0F || v <= 0.0F || w <= 0.0F) && (u >= 0.0F || v >= 0.0F || w >= 0.0F);
  }
  return (u < 0.0F || v < 0.0F || w < 0.0F) && (u > 0.0F || v > 0.0F || w > 0.0F);
}

/// A vertex as seen from the ray's origin, in the ray's order of axes: exact but for double's rounding.
Vec3d seen_vertex(const ShearedRay& ray, const float* vertex, std::size_t stride) {
  const auto along = [&](std::uint32_t axis) { return double{vertex[axis * stride]} - double{ray.origin[axis]}; };
  return {along(ray.axis_x), along(ray.axis_y), along(ray.axis_z)};
}

/// t of the plane of the lane that `rows` starts with, no farther than the triangle reaches: a ray that all but lies in the plane
/// crosses it anywhere. Not finite for a ray parallel to it.
double plane_distance(const ShearedRay& ray, const float* rows, std::size_t stride) {
  const Vec3d a = seen_vertex(ray, rows, stride), b = seen_vertex(ray, rows + 3 * stride, stride),
              c = seen_vertex(ray, rows + 6 * stride, stride);
  const Vec3d normal = cross(b - a, c - a);
  const double depth = dot(normal, a) / dot(normal, {double{ray.shear_x}, double{ray.shear_y}, 1.0});
  const auto [least, greatest] = std::minmax({a.z, b.z, c.z});
  return (std::isfinite(depth) ? std::clamp(depth, least, greatest) : depth) * double{ray.scale_z};
}

Vec3d row_vector(const float* rows, std::size_t stride, std::size_t lane, std::size_t row) {
  return {double{rows[row * stride + lane]}, double{rows[(row + 1) * stride + lane]}, double{rows[(row + 2) * stride + lane]}};
}

float rounded(double t) { return static_cast<float>(t); }

}  // namespace

ShearedRay::ShearedRay(const Ray& ray) : origin(ray.origin) {
  axis_z = largest_axis(ray.direction);
  axis_x = (axis_z + 1) % 3;
  axis_y = (axis_z + 2) % 3;
  if (ray.direction[axis_z] < 0.0F) {
    std::swap(axis_x, axis_y);  // keeps the winding
  }
  scale_z = 1.0F / ray.direction[axis_z];
  shear_x = ray.direction[axis_x] * scale_z;
  shear_y = ray.direction[axis_y] * scale_z;
}

float intersect_triangle(const ShearedRay& ray, const float* rows, std::size_t stride, std::size_t lane) {
  const ShearedVertex a(ray, rows + lane, stride), b(ray, rows + 3 * stride + lane, stride),
      c(ray, rows + 6 * stride + lane, stride);
  float u = edge(c, b), v = edge(a, c), w = edge(b, a);
  if (u == 0.0F || v == 0.0F || w == 0.0F) {
    u = exact_edge(c, b);
    v = exact_edge(a, c);
    w = exact_edge(b, a);
  }
  if (outside(u, v, w)) {
    return missed;
  }
  const float determinant = u + v + w;
  if (determinant == 0.0F) {
    return missed;
  }
  // Each weight is divided before the sum: a cubic in length would overflow and underflow far too soon.
  const float weighted = std::fma(u / determinant, a.z, std::fma(v / determinant, b.z, (w / determinant) * c.z));
  const float t = weighted * ray.scale_z;
  if (std::fabs(t) < near_start) {
    const double exact = plane_distance(ray, rows + lane, stride);
    return (exact > 0.0) == (t > 0.0F) ? t : exact > 0.0 ? rounded(exact) : missed;
  }
  return t;
}

float intersect_sphere(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane) {
  const double radius = double{rows[3 * stride + lane]};
  const Vec3d d(ray.direction), to_origin = Vec3d(ray.origin) - row_vector(rows, stride, lane, 0);
  const double a = dot(d, d), middle = -dot(to_origin, d) / a;
  const Vec3d nearest = to_origin + d * middle;
  const double rest = radius * radius - dot(nearest, nearest);
  if (!(rest >= 0.0)) {
    return missed;
  }
  const double half = std::sqrt(rest / a);
  const double near = middle - half, far = middle + half;
  return near > 0.0 && radius > 0.0 ? rounded(near) : far > 0.0 ? rounded(far) : missed;
}

namespace {

/// A cone as quantities that a ray changes linearly: X(t) = across + t * across_rate, r(t), h(t) in [0, 1].
struct ConeLine {
  Vec3d across, across_rate;
  double radius, radius_rate;
  double height, height_rate;

  /// d.N > 0 for N the outward normal at t.
  bool leaving(const Vec3d& d, const Vec3d& axis, double taper, double t) const {
    const Vec3d normal = across + across_rate * t - axis * ((radius + radius_rate * t) * taper);
    return dot(d, normal) > 0.0;
  }
};

/// The roots of A t^2 + 2 B t + C in ascending order; false if there is none.
bool solve(double a, double b, double c, double& first, double& second) {
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0.0)) {
    return false;
  }
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  first = a != 0.0 ? q / a : c / q;
  second = q != 0.0 ? c / q : first;
  if (!(std::isfinite(first) && std::isfinite(second))) {
    first = second = std::isfinite(second) ? second : first;
  }
  if (first > second) {
    std::swap(first, second);
  }
  return std::isfinite(first);
}

}  // namespace

float intersect_cone(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane) {
  const Vec3d base = row_vector(rows, stride, lane, 0), axis = row_vector(rows, stride, lane, 4) - base;
  const double signed_radius = double{rows[3 * stride + lane]}, base_radius = std::fabs(signed_radius);
  const double widening = std::fabs(double{rows[7 * stride + lane]}) - base_radius;
  const bool inside_only = signed_radius < 0.0 || rows[7 * stride + lane] < 0.0F;
  const Vec3d d(ray.direction), from_base = Vec3d(ray.origin) - base;
  const double shift = -dot(from_base, d) / dot(d, d), axis_squared = dot(axis, axis);
  const Vec3d start = from_base + d * shift;

  ConeLine line;
  line.height = dot(start, axis) / axis_squared;
  line.height_rate = dot(d, axis) / axis_squared;
  line.across = start - axis * line.height;
  line.across_rate = d - axis * line.height_rate;
  line.radius = base_radius + widening * line.height;
  line.radius_rate = widening * line.height_rate;

  double roots[2];
  if (!solve(dot(line.across_rate, line.across_rate) - line.radius_rate * line.radius_rate,
             dot(line.across, line.across_rate) - line.radius * line.radius_rate,
             dot(line.across, line.across) - line.radius * line.radius, roots[0], roots[1])) {
    return missed;
  }
  for (const double root : roots) {
    const double height = line.height + line.height_rate * root;
    if (root + shift > 0.0 && height >= 0.0 && height <= 1.0 &&
        (!inside_only || line.leaving(d, axis, widening / axis_squared, root))) {
      return rounded(root + shift);
    }
  }
  return missed;
}

}  // namespace dmpc::core
