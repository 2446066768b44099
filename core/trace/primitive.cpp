#include "core/trace/primitive.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "core/record/curved_values.h"
#include "core/record/record.h"
#include "core/trace/curved_solve.h"

namespace dmpc::core {
namespace {

std::uint32_t largest_axis(const Vec3f& d) {
  const float x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
  return x > y ? (x > z ? 0U : 2U) : (y > z ? 1U : 2U);
}

/// A vertex of a triangle in the sheared frame; z is not scaled yet.
struct ShearedVertex {
  float x, y, z;

  ShearedVertex(const ShearedRay& ray, const float* vertex, std::size_t stride) {
    z = vertex[ray.axis_z * stride] - ray.origin[ray.axis_z];
    x = std::fma(-ray.shear_x, z, vertex[ray.axis_x * stride] - ray.origin[ray.axis_x]);
    y = std::fma(-ray.shear_y, z, vertex[ray.axis_y * stride] - ray.origin[ray.axis_y]);
  }
};

float edge(const ShearedVertex& a, const ShearedVertex& b) { return a.x * b.y - a.y * b.x; }

/// Products of floats are exact in double, so the sign of the difference is.
float exact_edge(const ShearedVertex& a, const ShearedVertex& b) {
  return static_cast<float>(double{a.x} * double{b.y} - double{a.y} * double{b.x});
}

/// Whether the edge functions differ in sign; a zero has either sign, so an edge belongs to both of its triangles.
bool outside(float u, float v, float w) { return (u < 0.0F || v < 0.0F || w < 0.0F) && (u > 0.0F || v > 0.0F || w > 0.0F); }

/// A vertex relative to the ray's origin, in the ray's order of axes: exact except for the rounding of doubles.
Vec3d seen_vertex(const ShearedRay& ray, const float* vertex, std::size_t stride) {
  const auto along = [&](std::uint32_t axis) {
    return double{vertex[axis * stride]} - double{ray.origin[axis]} - double{ray.origin_rest[axis]};
  };
  return {along(ray.axis_x), along(ray.axis_y), along(ray.axis_z)};
}

/// A triangle relative to the ray's full origin, sheared in double.
struct SeenTriangle {
  SeenTriangle(const ShearedRay& ray, const float* rows, std::size_t stride)
      : shear{double{ray.shear_x}, double{ray.shear_y}, 1.0},
        scale_z(double{ray.scale_z}),
        a(seen_vertex(ray, rows, stride)),
        b(seen_vertex(ray, rows + 3 * stride, stride)),
        c(seen_vertex(ray, rows + 6 * stride, stride)) {}

  /// t of its plane, clamped to the triangle's extent: a ray that nearly lies in the plane crosses it anywhere. Not finite for a
  /// ray parallel to it.
  double plane_distance() const {
    const Vec3d normal = cross(b - a, c - a);
    const double depth = dot(normal, a) / dot(normal, shear);
    const auto [least, greatest] = std::minmax({a.z, b.z, c.z});
    return (std::isfinite(depth) ? std::clamp(depth, least, greatest) : depth) * scale_z;
  }
  /// An edge belongs to both of its triangles.
  bool is_crossed() const {
    const double u = turn(c, b), v = turn(a, c), w = turn(b, a);
    return !((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0));
  }

  /// The depths between which the ray is in the triangle's box, padded by `box_reach`; in reverse order if it never is.
  std::pair<double, double> depths_in_box() const {
    std::pair<double, double> depths{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
      const double one = (low - box_reach) / shear[axis], other = (high + box_reach) / shear[axis];
      if (shear[axis] != 0.0) {
        depths = {std::max(depths.first, std::min(one, other)), std::min(depths.second, std::max(one, other))};
      }
    }
    return depths;
  }

  Vec3d shear;
  double scale_z;
  Vec3d a, b, c;

 private:
  /// Only its sign changes when the vertices are swapped.
  double turn(const Vec3d& from, const Vec3d& to) const {
    const double from_x = from.x - shear.x * from.z, from_y = from.y - shear.y * from.z;
    const double to_x = to.x - shear.x * to.z, to_y = to.y - shear.y * to.z;
    return from_x * to_y - from_y * to_x;
  }
};

/// Distances that differ by less than this share are equal except for rounding.
constexpr double same_distance = 0x1p-20;

float rounded(double t) { return static_cast<float>(t); }

/// A t near 0, recomputed in double, of a triangle that the ray crosses according to floats.
float judged(float t, const SeenTriangle& seen) {
  const double exact = seen.plane_distance();
  if (!(exact > 0.0) || (exact < double{near_edge} && !seen.is_crossed())) {
    return missed;
  }
  return std::fabs(exact - double{t}) <= same_distance * exact ? t : rounded(exact);
}

/// The t of a triangle that, according to floats, the ray passes at an edge.
float judged_outside(const SeenTriangle& seen) {
  const double exact = seen.plane_distance();
  return exact > 0.0 && exact < double{near_edge} && seen.is_crossed() ? rounded(exact) : missed;
}

/// A triangle in the sheared frame with its edge functions.
struct ShearedTriangle {
  ShearedTriangle(const ShearedRay& ray, const float* rows, std::size_t stride)
      : a(ray, rows, stride),
        b(ray, rows + 3 * stride, stride),
        c(ray, rows + 6 * stride, stride),
        u(edge(c, b)),
        v(edge(a, c)),
        w(edge(b, a)),
        least(std::min(std::min(u, v), w)),
        greatest(std::max(std::max(u, v), w)) {
    if (u == 0.0F || v == 0.0F || w == 0.0F) {
      u = exact_edge(c, b);
      v = exact_edge(a, c);
      w = exact_edge(b, a);
    }
    determinant = u + v + w;
  }

  /// According to floats.
  bool is_passed() const { return outside(u, v, w); }
  /// Whether floats may be wrong about a triangle that the ray passes where doubles decide: see near_edge.
  bool is_doubtful(const ShearedRay& ray) const {
    if (!(std::min(std::min(a.z, b.z), c.z) < near_edge && std::max(std::max(a.z, b.z), c.z) > -near_edge)) {
      return false;
    }
    const auto across = [](const ShearedVertex& vertex) { return std::max(std::fabs(vertex.x), std::fabs(vertex.y)); };
    const float widest = std::max(std::max(across(a), across(b)), across(c));
    const float deepest = std::max(std::max(std::fabs(a.z), std::fabs(b.z)), std::fabs(c.z));
    return std::min(-least, greatest) <= (edge_rounding * std::max(widest, deepest) + rest_weight * ray.rest()) * widest;
  }
  /// The depth of the hit, not scaled yet. Each weight is divided before the sum: a product of third degree in length would
  /// overflow and underflow far too early.
  float depth() const { return std::fma(u / determinant, a.z, std::fma(v / determinant, b.z, (w / determinant) * c.z)); }

  ShearedVertex a, b, c;
  float u, v, w;
  float least, greatest;  ///< before zeros are distinguished
  float determinant = 0;
};

}  // namespace

ShearedRay::ShearedRay(const Ray& ray) : origin(ray.origin), origin_rest(ray.origin_rest) {
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
  const ShearedTriangle seen(ray, rows + lane, stride);
  if (seen.is_passed()) {
    return seen.is_doubtful(ray) ? judged_outside(SeenTriangle(ray, rows + lane, stride)) : missed;
  }
  if (seen.determinant == 0.0F) {
    return missed;
  }
  const float t = seen.depth() * ray.scale_z;
  return std::fabs(t) < near_start ? judged(t, SeenTriangle(ray, rows + lane, stride)) : t;
}

namespace {

/// The rate at which the ray rises above a plane along the axis on which it is sheared.
double approach_of(const ShearedRay& ray, const FacePlane& plane) {
  return plane.normal[ray.axis_x] * double{ray.shear_x} + plane.normal[ray.axis_y] * double{ray.shear_y} +
         plane.normal[ray.axis_z];
}

}  // namespace

double depth_of(const ShearedRay& ray, const FacePlane& plane) {
  const Vec3d origin = Vec3d(ray.origin) + Vec3d(ray.origin_rest);
  return -plane.height_of(origin) / approach_of(ray, plane);
}

float in_layer(float t, const ShearedRay& ray, const FacePlane& plane, std::int32_t layer) {
  if (!(t > 0.0F)) {
    return t;
  }
  const bool goes_up = (approach_of(ray, plane) > 0.0) == (ray.scale_z > 0.0F);
  const auto place = std::bit_cast<std::int32_t>(t);
  return std::bit_cast<float>(goes_up ? place + layer : std::max(place - layer, 1));
}

FacePlane level_plane_of(const float* rows, std::size_t stride, std::size_t lane) {
  FacePlane plane;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto coordinate = [&](std::size_t corner) { return rows[(3 * corner + axis) * stride + lane]; };
    if (coordinate(0) == coordinate(1) && coordinate(0) == coordinate(2)) {
      plane.normal[axis] = 1;
      plane.offset = double{coordinate(0)};
      break;
    }
  }
  return plane;
}

float intersect_shared_face(const ShearedRay& ray, double plane_depth, const float* rows, std::size_t stride, std::size_t lane) {
  const ShearedTriangle sheared(ray, rows + lane, stride);
  const bool is_passed = sheared.is_passed();
  if (!std::isfinite(plane_depth) || (is_passed ? !sheared.is_doubtful(ray) : sheared.determinant == 0.0F)) {
    return missed;
  }
  const SeenTriangle seen(ray, rows + lane, stride);
  const auto [least, greatest] = seen.depths_in_box();
  if (is_passed && !(least <= greatest)) {
    return missed;
  }
  const double depth = least <= greatest ? std::clamp(plane_depth, least, greatest) : double{sheared.depth()};
  const double t = depth * double{ray.scale_z};
  const bool is_near = t > 0.0 && t < double{near_edge};
  return is_near ? (seen.is_crossed() ? rounded(t) : missed) : is_passed ? missed : rounded(t);
}

double sphere_distance(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane) {
  const CurvedValues sphere(PrimitiveKind::sphere, rows, stride, lane);
  const auto [center, radius] = sphere.four(0);
  const SphereLine line(center, radius, ray.full_origin(), ray.full_direction());
  if (ray.kind == RayKind::primary && line.crossings.nearest_to_start(0.0) < next_to_start &&
      is_on_surface(sphere, dot(line.to_origin, line.to_origin) - radius * radius, radius,
                    largest_component(center) + std::fabs(radius))) {
    return line.middle > 0.0 ? line.crossings.second : double{missed};
  }
  return line.nearest_visible();
}

float intersect_sphere(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane) {
  return rounded(sphere_distance(ray, rows, stride, lane));
}

namespace {

/// Whether an eye, where the ray starts, is on the surface.
bool has_eye(const CurvedValues& cone, const ConeLine& line) {
  const Vec3d at = line.across + line.across_rate * -line.shift;
  const double there = line.radius + line.radius_rate * -line.shift,
               farthest = std::max(largest_component(cone.vector(0)), largest_component(cone.apex()));
  return is_on_surface(cone, dot(at, at) - there * there, there, farthest + std::fabs(there));
}

}  // namespace

double cone_distance(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane) {
  const CurvedValues cone(PrimitiveKind::cone, rows, stride, lane);
  ConeLine line(cone_values(cone), cone.is_flat(), ray.full_origin(), ray.full_direction());
  if (ray.kind == RayKind::primary && line.roots.nearest_to_start(line.shift) < next_to_start && has_eye(cone, line)) {
    const bool is_first = std::fabs(line.roots.first + line.shift) < std::fabs(line.roots.second + line.shift);
    (is_first ? line.roots.first : line.roots.second) = -std::numeric_limits<double>::infinity();
  }
  return line.nearest_visible(cone.is_inside_visible_only());
}

float intersect_cone(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane) {
  return rounded(cone_distance(ray, rows, stride, lane));
}

}  // namespace dmpc::core
