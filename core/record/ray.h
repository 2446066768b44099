// The self-contained ray: its own continuation, stack entry in svm and message in dataflow.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "core/base/vec.h"
#include "core/record/coordinate.h"

namespace dmpc::core {

/// scattered: the ray of a path after a surface has scattered it, also behind mirrors and glass.
enum class RayKind : std::uint8_t { primary, reflected, refracted, shadow, scattered };
inline constexpr std::size_t ray_kind_count = 5;

/// No primitive: a ray that missed, or one that starts on no flat primitive.
inline constexpr std::uint32_t no_primitive = 0xffffffffU;

/// A ray in grid-local coordinates (GridFrame in core/record/record.h). Nothing returns to the node that spawned it: where it
/// ends, it deposits light at `pixel` or spawns further rays (as pbrt-v4's wavefront work items do).
///
/// The grid, its boxes and the edges of triangles use a ray's floats. Computations in double, for curved surfaces and the points
/// and normals of hits, add the rests of their rounding, so that mirrors multiply hardly any error.
struct Ray {
  Vec3f origin;
  float t_max = std::numeric_limits<float>::infinity();  ///< hits count in (0, t_max)
  Vec3f direction;                                       ///< unit length, up to rounding
  std::uint32_t ignored_primitive = no_primitive;        ///< the triangle it starts on, which it cannot hit again
  Color weight{1, 1, 1};     ///< factor of the light it finds; for a shadow ray the light that it brings if nothing blocks it
  std::uint32_t pixel = 0;   ///< y * width + x
  std::uint16_t sample = 0;  ///< below the samples per pixel
  /// density_bits() of its direction when a surface scattered it; 0 if that is not needed, or there was no choice: rays of the
  /// eye, and of mirrors and glass.
  std::uint16_t density = 0;
  std::uint8_t depth = 1;  ///< 1 for a primary ray; a shadow ray has the depth of the ray whose hit cast it
  RayKind kind = RayKind::primary;
  /// cone_bits() of its cone's width at its start, 0 if no texture needs it; for a primary ray, of the start's distance from the
  /// eye.
  std::uint16_t cone = 0;
  Vec3f origin_rest, direction_rest;  ///< rests of rounding origin and direction

  /// Sets `origin` and its rest.
  void start_at(const Vec3d& point) {
    origin = coordinates_of(point);
    origin_rest = Vec3f(point - Vec3d(origin));
  }
  /// Sets `direction` and its rest.
  void go_along(const Vec3d& unit) {
    direction = Vec3f(unit);
    direction_rest = Vec3f(unit - Vec3d(direction));
  }
  /// Exact to 2^-49.
  Vec3d full_origin() const { return Vec3d(origin) + Vec3d(origin_rest); }
  Vec3d full_direction() const { return Vec3d(direction) + Vec3d(direction_rest); }
};
static_assert(sizeof(Ray) == 80 && std::is_trivially_copyable_v<Ray>);

/// A width, grid-local and not negative, as the upper half of a float: to 1 in 128, which is enough for a level of detail.
inline std::uint16_t cone_bits(double width) {
  return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(static_cast<float>(width)) >> 16U);
}
/// The width, at the ray's start, of the cone of all rays through its pixel (after J. Amanatides, "Ray Tracing with Cones",
/// SIGGRAPH 1984).
inline double cone_width(const Ray& ray) { return double{std::bit_cast<float>(std::uint32_t{ray.cone} << 16U)}; }

/// A density of directions, per steradian and above 0, as the upper half of a float, rounded to nearest: to 1 in 256. Light
/// sampling and BSDF sampling both use the rounded density for their weights, which add up to 1. Infinity, the density of a
/// mirror, is 0.
inline std::uint16_t density_bits(double density) {
  constexpr std::uint32_t least = 1, infinity = 0x7f80;
  const std::uint32_t bits = (std::bit_cast<std::uint32_t>(static_cast<float>(density)) + 0x8000U) >> 16U;
  return static_cast<std::uint16_t>(bits < infinity ? std::max(bits, least) : 0U);
}
/// The rounded density of density_bits().
inline double density_of(std::uint16_t bits) {
  return bits == 0 ? std::numeric_limits<double>::infinity() : double{std::bit_cast<float>(std::uint32_t{bits} << 16U)};
}

/// A direction's component below this counts as 0, denormals and -0 included.
inline constexpr float smallest_component = 1e-18F;

/// The reciprocal of each component of the ray's direction, never infinite: a component that counts as 0 is replaced by
/// smallest_component, with its sign.
inline Vec3d reciprocal_direction(const Ray& ray) {
  Vec3d reciprocal;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float component = ray.direction[axis];
    const bool counts = component >= smallest_component || component <= -smallest_component;
    reciprocal[axis] = 1.0 / double{counts ? component : std::copysign(smallest_component, component)};
  }
  return reciprocal;
}

}  // namespace dmpc::core
