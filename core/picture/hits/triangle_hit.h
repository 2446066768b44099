// Where a ray hit a triangle, in double: one straight line without calls and branches, so that compilers turn a loop over hits
// into vector instructions.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/vec.h"
#include "core/record/coordinate.h"

namespace dmpc::core {

// How far off its surface a ray starts: more than the point may be off, and the surfaces that go on there (after M. Pharr, W.
// Jakob, G. Humphreys, Physically Based Rendering, section 6.8: an offset follows from the bound of the error).

/// It starts off by so much of the largest coordinates, each by its share in the normal: vertices of triangles are rounded to
/// float, by 2^-25, and planes through others that were one plane may be off by a few times that.
inline constexpr double flat_clearance = 0x1p-22;
/// But by no more of the way to the triangle's own edge, behind which another may stand at a sharp angle: rays that start near it
/// must not start behind that one. Triangles that share an edge agree about it however near it is.
inline constexpr double edge_clearance = 0x1p-6;
/// Points keep off edges by so much of their coordinates, so that there is such a way, far longer than rays' starts are exact.
inline constexpr double edge_inset = 0x1p-34;
/// But they keep no farther off than this share of the triangle.
inline constexpr double weight_least_max = 0x1p-8;
/// And it starts off by so much of the ray's t, which is rounded to float: another surface may lie so much nearer.
inline constexpr double tie_clearance = 0x1p-23;

/// The plane's unit normal, by the winding of its corners.
inline Vec3d unit_normal_of(const Vec3d& edge1, const Vec3d& edge2) {
  const Vec3d normal = cross(edge1, edge2);
  return normal * (1.0 / length(normal));
}

inline double height_of(const Vec3d& edge1, const Vec3d& edge2) {
  return least_altitude(edge1, edge2, edge2 - edge1, length(cross(edge1, edge2)));
}

/// The largest coordinate of where a ray is at t.
inline double place_of(const Vec3d& origin, const Vec3d& direction, double t) {
  return largest_component(origin + direction * t);
}

/// Hands the barycentric weights of the second and third corner to `set`, after T. Moeller, B. Trumbore, "Fast, Minimum Storage
/// Ray/Triangle Intersection", 1997; clamped, so that their point lies on the triangle even where the float test let the ray in
/// by rounding. 0 if the ray lies in the plane. `to_origin`: of the ray, from the first corner; `place`: place_of() the hit.
template <class Set>
void find_weights(const Vec3d& edge1, const Vec3d& edge2, const Vec3d& to_origin, const Vec3d& direction, double place,
                  const Set& set) {
  const Vec3d p = cross(direction, edge2);
  const double determinant = dot(edge1, p);
  const double least = std::min(edge_inset * place / height_of(edge1, edge2), weight_least_max);
  const double u = std::max(std::min(dot(to_origin, p) / determinant, 1.0 - 2 * least), least);
  const double most = std::max(1.0 - least - u, least);  // but for rounding it is no less anyway
  const double v = std::max(std::min(dot(direction, cross(to_origin, edge1)) / determinant, most), least);
  set(determinant != 0.0 ? u : 0.0, determinant != 0.0 ? v : 0.0);
}

inline Vec3d point_at(const Vec3d& corner, const Vec3d& edge1, const Vec3d& edge2, double u, double v) {
  return corner + edge1 * u + edge2 * v;
}

/// How far it is to the nearest edge from where the triangle has these weights, or less.
inline double way_to_edge(const Vec3d& edge1, const Vec3d& edge2, double u, double v) {
  return std::max(std::min(std::min(u, v), 1.0 - u - v), 0.0) * height_of(edge1, edge2);
}

/// How far off a triangle rays start that leave it where it has these weights, hit at t; `normal`: of its plane.
inline double clearance_of(const Vec3d& corner, const Vec3d& edge1, const Vec3d& edge2, const Vec3d& normal, double u, double v,
                           double t) {
  const double rounding =
      flat_clearance * std::max(std::max(dot_of_magnitudes(normal, corner), dot_of_magnitudes(normal, corner + edge1)),
                                dot_of_magnitudes(normal, corner + edge2));
  return std::min(rounding + tie_clearance * t, edge_clearance * way_to_edge(edge1, edge2, u, v));
}

/// The same of one in an exact plane, at `point`: by what doubles leave of it.
inline double exact_clearance_of(const Vec3d& edge1, const Vec3d& edge2, const Vec3d& normal, const Vec3d& point, double u,
                                 double v) {
  return std::min(exact_clearance * dot_of_magnitudes(normal, point), edge_clearance * way_to_edge(edge1, edge2, u, v));
}

}  // namespace dmpc::core
