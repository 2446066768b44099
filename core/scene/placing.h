// What a place does to a mesh, grid-local.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/record/record.h"
#include "core/scene/frame.h"
#include "core/scene/transform.h"

namespace dmpc::core {

/// As records have it: of unit length to rounding, or 0 if it has no direction.
inline Vec3f unit_normal(const Vec3d& normal) {
  const double size = length(normal);
  return size > 0 && std::isfinite(size) ? Vec3f(normal * (1.0 / size)) : Vec3f{};
}

/// A plane of a mesh, in the mesh's coordinates.
struct MeshPlane : FacePlane {
  std::uint8_t kept_as = BlockHeader::shared_plane;  ///< BlockHeader::plane
  bool is_level = false;  ///< `normal` is an axis, and all corners of its faces have `offset` there, to the bit
};

/// A mesh's corners and planes where an instance has them, in double, in one order of operations: whoever places a thing gets
/// these bits.
class Placing {
 public:
  Placing(const Transform& world, const GridFrame& frame) : world_(world), frame_(frame), normals_(world.of_normals()) {}

  bool is_mirrored() const { return world_.determinant() < 0; }
  /// A corner, which coordinate_of() has yet to round.
  Vec3d corner(const Vec3d& at) const { return to_local(frame_, world_.point(at)); }
  /// Nothing if doubles cannot tell. It faces the side that the mesh's does, in a mirror, too.
  std::optional<FacePlane> plane(const MeshPlane& plane) const {
    const Vec3d way = normals_.direction(plane.normal);
    const double size = length(way);
    if (!(size > 0) || !std::isfinite(size)) {
      return std::nullopt;
    }
    const Vec3d normal = way * (1.0 / size);
    return FacePlane{normal, dot(normal, corner(plane.normal * plane.offset))};
  }
  /// Whether faces of a level plane have a coordinate in common here, too, to the bit.
  bool stays_level(const MeshPlane& plane) const {
    if (!plane.is_level) {
      return false;
    }
    for (const Vec3d& row : world_.rows) {
      bool follows = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        follows = follows && (row[axis] == 0 || plane.normal[axis] != 0);
      }
      if (follows) {
        return true;
      }
    }
    return false;
  }
  /// How long the longest way of a mesh's unit is here, or longer by no more than the square root of 3.
  double size_of_unit() const {
    double square = 0;
    for (const Vec3d& row : world_.rows) {
      square += dot(row, row);
    }
    return std::sqrt(square) * frame_.scale;
  }

 private:
  const Transform& world_;
  const GridFrame& frame_;
  Transform normals_;
};

}  // namespace dmpc::core
