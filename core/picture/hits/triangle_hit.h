// Where a ray hit a triangle, in double: code without calls and branches, so that compilers vectorise loops over hits.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/vec.h"
#include "core/record/coordinate.h"

namespace dmpc::core {

// How far off its surface a ray starts: more than the error of the point, and of surfaces that continue there (after M. Pharr, W.
// Jakob, G. Humphreys, Physically Based Rendering, section 6.8: an offset follows from the bound of the error).

/// Offset as a share of the largest coordinates, weighted by the normal's components: vertices of triangles are rounded to float,
/// by 2^-25, and planes through vertices that were in one plane may be off by a few times that.
inline constexpr double flat_clearance = 0x1p-22;
/// The offset is at most this share of the distance to the triangle's edge, behind which another triangle may stand at a sharp
/// angle: rays that start near the edge must not start behind that one. Triangles that share an edge agree about it at any
/// distance.
inline constexpr double edge_clearance = 0x1p-6;
/// Points keep this share of their coordinates off edges, so that the distance is far larger than the precision of rays' starts.
inline constexpr double edge_inset = 0x1p-34;
/// But no farther off than this share of the triangle.
inline constexpr double weight_least_max = 0x1p-8;
/// Offset as a share of the ray's t, which is rounded to float: another surface may be nearer by this much.
inline constexpr double tie_clearance = 0x1p-23;

/// The plane's unit normal, oriented by the corners' order.
inline Vec3d unit_normal_of(const Vec3d& edge1, const Vec3d& edge2) {
  const Vec3d normal = cross(edge1, edge2);
  return normal * (1.0 / length(normal));
}

inline double height_of(const Vec3d& edge1, const Vec3d& edge2) {
  return least_altitude(edge1, edge2, edge2 - edge1, length(cross(edge1, edge2)));
}

/// The largest coordinate of the ray's point at t.
inline double place_of(const Vec3d& origin, const Vec3d& direction, double t) {
  return largest_component(origin + direction * t);
}

/// Passes the barycentric weights of the second and third corner to `set`, after T. Moeller, B. Trumbore, "Fast, Minimum Storage
/// Ray/Triangle Intersection", 1997; clamped, so that their point lies on the triangle even where the float test accepted the ray
/// by rounding. 0 if the ray lies in the plane. `to_origin`: of the ray, from the first corner; `place`: place_of() the hit.
template <class Set>
void find_weights(const Vec3d& edge1, const Vec3d& edge2, const Vec3d& to_origin, const Vec3d& direction, double place,
                  const Set& set) {
  const Vec3d p = cross(direction, edge2);
  const double determinant = dot(edge1, p);
  const double least = std::min(edge_inset * place / height_of(edge1, edge2), weight_least_max);
  const double u = std::max(std::min(dot(to_origin, p) / determinant, 1.0 - 2 * least), least);
  const double most = std::max(1.0 - least - u, least);  // not less, up to rounding
  const double v = std::max(std::min(dot(direction, cross(to_origin, edge1)) / determinant, most), least);
  set(determinant != 0.0 ? u : 0.0, determinant != 0.0 ? v : 0.0);
}

inline Vec3d point_at(const Vec3d& corner, const Vec3d& edge1, const Vec3d& edge2, double u, double v) {
  return corner + edge1 * u + edge2 * v;
}

/// A lower bound of the distance to the nearest edge from the point with these weights.
inline double way_to_edge(const Vec3d& edge1, const Vec3d& edge2, double u, double v) {
  return std::max(std::min(std::min(u, v), 1.0 - u - v), 0.0) * height_of(edge1, edge2);
}

/// Clearance of rays that leave a triangle at these weights, hit at t; `normal`: of its plane.
inline double clearance_of(const Vec3d& corner, const Vec3d& edge1, const Vec3d& edge2, const Vec3d& normal, double u, double v,
                           double t) {
  const double rounding =
      flat_clearance * std::max(std::max(dot_of_magnitudes(normal, corner), dot_of_magnitudes(normal, corner + edge1)),
                                dot_of_magnitudes(normal, corner + edge2));
  return std::min(rounding + tie_clearance * t, edge_clearance * way_to_edge(edge1, edge2, u, v));
}

/// Clearance on a triangle in an exact plane, at `point`: from the error of doubles.
inline double exact_clearance_of(const Vec3d& edge1, const Vec3d& edge2, const Vec3d& normal, const Vec3d& point, double u,
                                 double v) {
  return std::min(exact_clearance * dot_of_magnitudes(normal, point), edge_clearance * way_to_edge(edge1, edge2, u, v));
}

}  // namespace dmpc::core
