// Intersection of one ray with one primitive: the scalar twins that every other kernel must equal bit for bit.
#pragma once

#include <cstdint>

#include "core/record/ray.h"
#include "core/record/record.h"

namespace dmpc::core {

/// A ray sheared so that it runs along +z through the origin: a pure function of the ray's bits.
/// Source: S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
struct ShearedRay {
  explicit ShearedRay(const Ray& ray);
  /// From values that have been computed before.
  ShearedRay(const Vec3f& start, const Vec3f& rest, float x_shear, float y_shear, float z_scale, std::uint32_t x, std::uint32_t y,
             std::uint32_t z)
      : origin(start), origin_rest(rest), shear_x(x_shear), shear_y(y_shear), scale_z(z_scale), axis_x(x), axis_y(y), axis_z(z) {}

  /// How far the ray starts from the position that its floats give, along any axis.
  float rest() const { return largest_component(origin_rest); }

  Vec3f origin, origin_rest;
  float shear_x, shear_y, scale_z;
  std::uint32_t axis_x, axis_y, axis_z;  ///< which coordinate plays x, y, z; axis_z is the direction's largest
};

/// Nearer to 0 than this the sign of a triangle's t is decided in double. Rounding moves t by about 2^-24 of the distance, times
/// E^3 / A on a triangle of length E and area A.
inline constexpr float near_start = 0x1p-10F;

/// Nearer than this a hit of a triangle is decided in doubles: a ray that starts next to an edge must neither hit, from within,
/// the triangle behind that edge, nor pass between two triangles that share one because each is decided in another arithmetic. It
/// is less than near_start by more than the error of t, so that neighbours are decided alike.
inline constexpr float near_edge = 0x1p-12F;
/// Edge functions in floats are off by less than (edge_rounding * R + rest_weight * rest) * W, where W is the triangle's largest
/// coordinate across the ray and R any of its largest, as seen from the ray's start: 140 u R W
/// (apps/lab/oracle/exact_intersection.cpp), and what the start's rest moves an edge by.
inline constexpr float edge_rounding = 160 * 0x1p-24F, rest_weight = 8;

/// Faces whose plane is shared are hit only within this of the boxes of their corners: farther than rounding moves the plane, but
/// less than insertion_pad().
inline constexpr double box_reach = 0x1p-22;

/// The t of a ray that misses: never in (0, t_max).
inline constexpr float missed = -1.0F;

/// `rows` points at a leaf's first value, `stride` is its lane count. Returns the t of the hit of lane `lane`, or `missed`.
/// Triangles: float, edge functions without fused operations, decided in double when one is zero (watertight along shared edges
/// and at shared vertices), barycentric weights divided before t is summed, so that scaling all coordinates by a power of two
/// scales t exactly. A t nearer to 0 than `near_start` whose sign differs from that of double's t (within the triangle's depths)
/// is replaced by it: on needles t is off by more than a secondary ray's offset from its surface, and the ray must neither hit
/// what shares its surface's plane nor pass what lies ahead.
float intersect_triangle(const ShearedRay& ray, const float* rows, std::size_t stride, std::size_t lane);

/// Where, in double, the ray crosses a plane that triangles share, along the axis of its shear: t / scale_z, the same for all of
/// them. Not finite for a ray parallel to it.
double depth_of(const ShearedRay& ray, const FacePlane& plane);

/// The plane of a triangle whose corners agree in one coordinate.
FacePlane level_plane_of(const float* rows, std::size_t stride, std::size_t lane);

/// intersect_triangle() of a face whose plane others share: it is hit where the plane is, at the same t as they. A ray that
/// nearly lies in the plane hits it no farther than `box_reach` from the triangle's box, so that t is not less than where the ray
/// enters the boxes around it.
float intersect_shared_face(const ShearedRay& ray, double plane_depth, const float* rows, std::size_t stride, std::size_t lane);

/// The t of a hit in an exact plane, moved by as many units in the last place as the plane's layer says, so that planes between
/// which a float cannot tell are met in their order: away where the ray goes up through the layers, else towards its start.
float in_layer(float t, const ShearedRay& ray, const FacePlane& plane, std::int32_t layer);

/// Spheres and cones: solved in double around the point of the ray nearest to the centre (base), to avoid cancellation at a
/// distance; t is rounded to float once. A negative radius shows the inside only. Returns the nearest root with t > 0.
float intersect_sphere(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane);
float intersect_cone(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane);
/// The t of a sphere before it is rounded; `missed` if the ray misses.
double sphere_distance(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane);
double cone_distance(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane);

}  // namespace dmpc::core
