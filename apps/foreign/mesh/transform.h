// From a node's coordinates to the world's.
#pragma once

#include <assimp/matrix4x4.h>
#include <assimp/vector3.h>

#include <array>

#include "core/base/vec.h"

namespace dmpc::apps {

inline core::Vec3d to_vec(const aiVector3D& v) { return {double{v.x}, double{v.y}, double{v.z}}; }

/// An affine map in double precision: `rows` of its linear part, then a shift.
struct Transform {
  std::array<core::Vec3d, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  core::Vec3d shift;

  core::Vec3d direction(const core::Vec3d& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  core::Vec3d point(const core::Vec3d& v) const { return direction(v) + shift; }
  /// Its sign is that of a mirror if below 0.
  double determinant() const { return dot(rows[0], cross(rows[1], rows[2])); }
  /// The transform of normals, up to a length above 0: the inverse transpose times the determinant's magnitude.
  Transform of_normals() const;
};

/// Multiplies by `factor`.
Transform scaling(double factor);
/// First `local`, then `world`.
Transform operator*(const Transform& world, const aiMatrix4x4& local);

}  // namespace dmpc::apps
