// A triangle as a part of its plane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/altitude.h"
#include "core/base/vec.h"
#include "core/database/database.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Rounding to float moves a coordinate by this share of it at most.
inline constexpr double corner_rounding = 0x1p-25;

/// `id`: of the primitive; `object`: that it is of.
struct Face {
  Face(const PrimitiveValues& triangle, std::uint32_t primitive, std::uint32_t of_object) : id(primitive), object(of_object) {
    for (std::size_t i = 0; i < 3; ++i) {
      corner[i] = triangle.vector(3 * i);
    }
    const Vec3d area = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double twice = length(area);
    plane.normal = area * (1.0 / twice);
    plane.offset = dot(plane.normal, corner[0]);
    for (const Vec3d& at : corner) {
      moved = std::max(moved, corner_rounding * dot_of_magnitudes(plane.normal, at));
    }
    altitude = least_altitude(corner[1] - corner[0], corner[2] - corner[1], corner[0] - corner[2], twice);
  }

  /// The axis that the plane faces most.
  std::size_t main_axis() const {
    const Vec3d& n = plane.normal;
    const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  }
  Vec3d middle() const { return (corner[0] + corner[1] + corner[2]) * (1.0 / 3); }

  std::array<Vec3d, 3> corner;
  FacePlane plane;
  double altitude = 0;  ///< the least of the three
  double moved = 0;     ///< how far rounding moves a corner across the plane at most
  std::uint32_t id, object;
};

/// Triangles that lie side by side may cover each other by so much.
inline constexpr double sliver = 0x1p-22;

/// Whether two triangles lie in one plane but for rounding.
bool are_coplanar(const Face& a, const Face& b);

/// Whether two triangles of one plane cover each other, seen along an axis, by more than rounding does to triangles side by side.
bool cover(const Face& a, const Face& b, std::size_t axis);

/// Whether a face lies in a plane that it is to share.
bool lies_in(const Face& face, const FacePlane& plane);

}  // namespace dmpc::core
