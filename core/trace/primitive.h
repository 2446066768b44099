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
  /// Takes what has been computed before.
  ShearedRay(const Vec3f& start, const Vec3f& rest, float x_shear, float y_shear, float z_scale, std::uint32_t x, std::uint32_t y,
             std::uint32_t z)
      : origin(start), origin_rest(rest), shear_x(x_shear), shear_y(y_shear), scale_z(z_scale), axis_x(x), axis_y(y), axis_z(z) {}

  /// How far the ray starts from where its floats say, along any axis.
  float rest() const { return largest_component(origin_rest); }

  Vec3f origin, origin_rest;
  float shear_x, shear_y, scale_z;
  std::uint32_t axis_x, axis_y, axis_z;  ///< which coordinate plays x, y, z; axis_z is the direction's largest
};

/// Nearer to 0 than this the sign of a triangle's t is decided in double. Rounding moves t by some 2^-24 of the distance, on a
/// triangle of length E and area A by E^3 / A times as much.
inline constexpr float near_start = 0x1p-10F;

/// Nearer than this a triangle is hit where doubles say so, whatever floats say: a ray that starts next to an edge must not meet,
/// from within, the triangle behind that edge, nor fall between two that share one because each is asked of another arithmetic.
/// Less than near_start by more than t is off, so that neighbours are judged alike.
inline constexpr float near_edge = 0x1p-12F;
/// Edge functions in floats are off by less than (edge_rounding * R + rest_weight * rest) * W, where W is the triangle's largest
/// coordinate across the ray, R any of its largest, as seen from where the ray starts: 140 u R W
/// (apps/lab/oracle/exact_intersection.cpp), and what the start's rest moves an edge by.
inline constexpr float edge_rounding = 160 * 0x1p-24F, rest_weight = 8;

/// Faces whose plane is shared are hit within this of the boxes of their corners: farther than rounding moves the plane, by less
/// than insertion_pad().
inline constexpr double box_reach = 0x1p-22;

/// The t of a ray that misses: never in (0, t_max).
inline constexpr float missed = -1.0F;

/// `rows` points at a leaf's first value, `stride` is its lane count. Returns the t of the hit of lane `lane`, or `missed`.
/// Triangles: float, edge functions unfused, decided in double when one is zero (watertight along shared edges and at shared
/// vertices), barycentric weights divided before t is summed, so that scaling all coordinates by a power of two scales t exactly.
/// A t nearer to 0 than `near_start` whose sign is not that of double's t (within the triangle's depths) gives way to it: on
/// needles t is off by more than a secondary ray starts off its surface, and the ray must neither hit what shares its surface's
/// plane nor pass what lies ahead.
float intersect_triangle(const ShearedRay& ray, const float* rows, std::size_t stride, std::size_t lane);

/// Where, in double, the ray crosses a plane that triangles share, along the axis on which it is sheared: t / scale_z, the same
/// for all of them. Not finite for a ray parallel to it.
double depth_of(const ShearedRay& ray, const FacePlane& plane);

/// The plane of a triangle whose corners have a coordinate in common.
FacePlane level_plane_of(const float* rows, std::size_t stride, std::size_t lane);

/// intersect_triangle() of a face whose plane others share: it is hit where the plane is, at the same t as they, but for a ray
/// that all but lies in the plane: it is hit no farther than `box_reach` from the triangle's box, so that its t is not less than
/// where a ray enters the boxes around it.
float intersect_shared_face(const ShearedRay& ray, double plane_depth, const float* rows, std::size_t stride, std::size_t lane);

/// The t of a hit in an exact plane, moved by as many units in the last place as the plane's layer says, so that planes between
/// which a float cannot tell are met in their order: away where the ray goes up through the layers, else towards its start.
float in_layer(float t, const ShearedRay& ray, const FacePlane& plane, std::int32_t layer);

/// Spheres and cones: solved in double about the point of the ray nearest to the centre (base), so that distance cancels nothing;
/// t rounded to float once. A negative radius shows the inside only. Nearest root with t > 0.
float intersect_sphere(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane);
float intersect_cone(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane);
/// The t of a sphere before it is rounded; `missed` if the ray misses.
double sphere_distance(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane);
double cone_distance(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane);

}  // namespace dmpc::core
