// From a mesh's coordinates to the world's.
#pragma once

#include <array>

#include "core/base/vec.h"

namespace dmpc::core {

/// An affine map in double precision: `rows` of its linear part, then a shift.
struct Transform {
  std::array<Vec3d, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vec3d shift;

  Vec3d direction(const Vec3d& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  Vec3d point(const Vec3d& v) const { return direction(v) + shift; }
  /// Below 0 for a mirror.
  double determinant() const { return dot(rows[0], cross(rows[1], rows[2])); }
  /// The transform of normals, up to a length above 0: the inverse transpose times the determinant's magnitude.
  Transform of_normals() const {
    const double sign = determinant() < 0 ? -1 : 1;
    return {{cross(rows[1], rows[2]) * sign, cross(rows[2], rows[0]) * sign, cross(rows[0], rows[1]) * sign}, {}};
  }
};

}  // namespace dmpc::core
