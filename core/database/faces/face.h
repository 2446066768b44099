// A triangle as a part of its plane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/vec.h"
#include "core/database/database.h"
#include "core/record/record.h"

namespace dmpc::core {

/// The largest relative error of a coordinate that is rounded to float.
inline constexpr double corner_rounding = 0x1p-25;

/// `id`: of the primitive; `object`: the object that it belongs to.
struct Face {
  /// With the records' values.
  Face(const PrimitiveValues& triangle, std::uint32_t primitive, std::uint32_t of_object)
      : Face({triangle.vector(0), triangle.vector(3), triangle.vector(6)}, {}, corner_rounding, primitive, of_object) {}
  /// The relative error of coordinates, and of those `beside` them with which they were computed, is `rounding`.
  Face(const std::array<Vec3d, 3>& corners, const Vec3d& beside, double rounding, std::uint32_t primitive,
       std::uint32_t of_object)
      : corner(corners), id(primitive), object(of_object) {
    const Vec3d area = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double twice = length(area);
    plane.normal = area * (1.0 / twice);
    plane.offset = dot(plane.normal, corner[0]);
    const double by_beside = dot_of_magnitudes(plane.normal, beside);
    const auto moved_by = [&](const Vec3d& at) { return rounding * (dot_of_magnitudes(plane.normal, at) + by_beside); };
    moved = std::max({moved_by(corner[0]), moved_by(corner[1]), moved_by(corner[2])});
    altitude = least_altitude(corner[1] - corner[0], corner[2] - corner[1], corner[0] - corner[2], twice);
  }

  /// The axis that the plane faces most.
  std::size_t main_axis() const {
    const Vec3d& n = plane.normal;
    const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  }
  /// Whether its corners have the same coordinate along its main axis.
  bool is_level() const {
    const std::size_t main = main_axis();
    return corner[0][main] == corner[1][main] && corner[0][main] == corner[2][main];
  }
  /// The length of its longest edge.
  double longest() const {
    return std::max({length(corner[1] - corner[0]), length(corner[2] - corner[1]), length(corner[0] - corner[2])});
  }
  Vec3d middle() const { return (corner[0] + corner[1] + corner[2]) * (1.0 / 3); }

  std::array<Vec3d, 3> corner;
  FacePlane plane;
  double altitude = 0;  ///< the least of the three altitudes
  double moved = 0;     ///< the largest distance by which rounding moves a corner across the plane
  std::uint32_t id, object;
  bool is_by_doubles = false;  ///< its corners are not rounded to float, so that its slopes are known for any `moved`
};

/// In a scene of size about 1 lower triangles are turned by rounding to float as far as two near planes lean.
inline constexpr double low_altitude = 0x1p-12;

/// Adjacent triangles may overlap by this much.
inline constexpr double sliver = 0x1p-22;

/// Whether two triangles that are near merely touch each other, up to rounding: one lies on one side of the other one's plane,
/// and they have no corner in common, unlike neighbours in a mesh; and whether they lean by so little that rounding swaps a 128th
/// of the smaller one, or more.
bool are_leaning(const Face& a, const Face& b);

/// The maximum distance of the corners of the smaller of two triangles from the plane of the other, in multiples of the possible
/// rounding there.
double roundings_apart(const Face& a, const Face& b);

/// Whether two triangles lie in one plane up to rounding.
bool are_coplanar(const Face& a, const Face& b);

/// Planes are near if they are apart, but by no more than this many times the rounding: a ray that starts on one starts behind
/// the other (core/picture/hits/triangle_hit.h).
inline constexpr double near_roundings = 16;
/// Planes that are no farther apart than this are near, too: seen from 16 times its size away, both faces are hit at the same
/// float t, or even from a thousand times where t loses no more than coordinates across the scene.
inline double tie_of(double size) { return 0x1p-20 * size + std::min(0x1p-14 * size, 0x1p-24); }
/// Whether some corner of the smaller of two triangles is near to the plane of the other, or they lie on both of its sides, and
/// none is `leaning_nears` times as far.
bool are_near(const Face& a, const Face& b);
inline constexpr double leaning_nears = 64;

/// Layers move no t, which is at most 8, farther than this: faces farther apart are hit in order.
inline constexpr double layers_reach = plane_layers_max * 0x1p-21;
/// For a face of a size, seen from a thousand times that at most.
inline double layers_reach_of(double size) { return std::min(layers_reach, 0x1p-10 * size); }
/// are_near(), within the reach of layers.
bool are_in_reach(const Face& a, const Face& b);

/// Whether two triangles of one plane cover each other, seen along an axis, by more than rounding causes between adjacent ones.
bool cover(const Face& a, const Face& b, std::size_t axis);

/// Whether a face lies in a plane that it is to share.
bool lies_in(const Face& face, const FacePlane& plane);

}  // namespace dmpc::core
