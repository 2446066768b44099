// A planar polygon projected along its normal: two coordinates per corner, and the turns of three corners.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/vec.h"

namespace dmpc::core {

/// Corner indices.
using CornerTriangle = std::array<std::uint32_t, 3>;

/// Projected along the largest axis of its normal, counter-clockwise. `vertices` outlive it.
class FlatPolygon {
 public:
  FlatPolygon(std::span<const Vec3d> vertices, const Vec3d& normal) : vertices_(vertices) {
    const Vec3d size{std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
    const std::size_t axis = size.x >= size.y ? (size.x >= size.z ? 0U : 2U) : (size.y >= size.z ? 1U : 2U);
    u_ = (axis + 1) % 3;
    v_ = (axis + 2) % 3;
    sign_ = normal[axis] < 0 ? -1.0 : 1.0;
  }

  std::uint32_t count() const { return static_cast<std::uint32_t>(vertices_.size()); }
  /// -1 if it is projected from below: then a right turn of the coordinates is a left turn.
  double sign() const { return sign_; }
  /// A corner's coordinate 0 or 1.
  double coordinate(std::uint32_t corner, std::size_t side) const { return vertices_[corner][side == 0 ? u_ : v_]; }
  bool same_place(std::uint32_t a, std::uint32_t b) const { return vertices_[a] == vertices_[b]; }
  /// Above 0 if a, b, c turn left.
  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Vec3d ab = vertices_[b] - vertices_[a], ac = vertices_[c] - vertices_[a];
    return sign_ * (ab[u_] * ac[v_] - ab[v_] * ac[u_]);
  }
  /// Whether a corner lies in the triangle, including its edges, but not at one of its corners.
  bool hinders(std::uint32_t p, const CornerTriangle& t) const {
    return turn(t[0], t[1], p) >= 0 && turn(t[1], t[2], p) >= 0 && turn(t[2], t[0], p) >= 0 && !same_place(p, t[0]) &&
           !same_place(p, t[1]) && !same_place(p, t[2]);
  }

 private:
  std::span<const Vec3d> vertices_;
  std::size_t u_, v_;
  double sign_;
};

}  // namespace dmpc::core
