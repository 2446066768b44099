// The transform of a mesh by an instance: its extent, and the transforms of its corners, planes and records into the grid.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/base/box.h"
#include "core/base/ranges.h"
#include "core/base/vec.h"
#include "core/record/instance.h"
#include "core/record/record.h"
#include "core/scene/frame.h"
#include "core/scene/transform.h"

namespace dmpc::core {

inline Vec3d magnitudes(const Vec3d& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

/// A box that holds all transformed corners, in doubles, of a mesh with the box `own`. Not finite at the limits of doubles; no
/// other box holds it then.
inline Box reach_of(const Box& own, const Transform& world) {
  constexpr double rounding = 0x1p-40;  // relative to the summands: far more than the error of doubles
  const Vec3d middle = world.point(own.center()), half = own.half(), largest = magnitudes(own.center()) + half;
  Box reach;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3d way = magnitudes(world.rows[axis]);
    const double away = dot(way, half) + (dot(way, largest) + std::fabs(world.shift[axis])) * rounding;
    reach.low[axis] = middle[axis] - away;
    reach.high[axis] = middle[axis] + away;
  }
  return reach;
}

inline Transform transform_of(const InstanceRecord& instance) {
  const auto& world = instance.world;
  return {.rows = {{{world[0], world[1], world[2]}, {world[3], world[4], world[5]}, {world[6], world[7], world[8]}}},
          .shift = {world[9], world[10], world[11]}};
}

/// By columns, for a linear part that can_be_instanced().
inline std::array<Vec3d, 3> inverse_of(const std::array<Vec3d, 3>& rows) {
  const double share = 1 / dot(rows[0], cross(rows[1], rows[2]));
  return {cross(rows[1], rows[2]) * share, cross(rows[2], rows[0]) * share, cross(rows[0], rows[1]) * share};
}

/// The linear part of the transform into the grid from a mesh's records, which have this unit.
inline std::array<Vec3d, 3> rows_in_grid(const Transform& world, double unit, const GridFrame& frame) {
  std::array<Vec3d, 3> rows;
  for (std::size_t row = 0; row < 3; ++row) {
    rows[row] = world.rows[row] * (unit * frame.scale);
  }
  return rows;
}

/// For boxes, in double: rows m + shift of a point m in units of the mesh's records. Corners of triangles are transformed by
/// Placing (below), in another order of operations.
struct MeshToGrid {
  MeshToGrid(const InstanceRecord& instance, const GridFrame& frame)
      : rows(rows_in_grid(transform_of(instance), double{instance.unit}, frame)),
        shift(to_local(frame, transform_of(instance).shift)) {}

  std::array<Vec3d, 3> rows;
  Vec3d shift;
};

/// As in records: of unit length up to rounding, or 0 if it has no direction.
inline Vec3f unit_normal(const Vec3d& normal) {
  const double size = length(normal);
  return size > 0 && std::isfinite(size) ? Vec3f(normal * (1.0 / size)) : Vec3f{};
}

/// A plane of a mesh, in the mesh's coordinates.
struct MeshPlane : FacePlane {
  std::uint8_t stored_as = LeafHeader::shared_plane;  ///< LeafHeader::plane
  bool is_level = false;  ///< `normal` is an axis, and all corners of its faces have exactly `offset` there
};

/// Transforms a mesh's corners and planes by an instance, in double, in one order of operations: the only source of these bits.
class Placing {
 public:
  Placing(const Transform& world, const GridFrame& frame) : world_(world), frame_(frame), normals_(world.of_normals()) {}

  bool is_mirrored() const { return world_.determinant() < 0; }
  /// A corner, before it is rounded by coordinate_of().
  Vec3d corner(const Vec3d& at) const { return to_local(frame_, world_.point(at)); }
  /// Nothing if doubles cannot tell. It faces the same side as the mesh's, even if mirrored.
  std::optional<FacePlane> plane(const MeshPlane& plane) const {
    const Vec3d way = normals_.direction(plane.normal);
    const double size = length(way);
    if (!(size > 0) || !std::isfinite(size)) {
      return std::nullopt;
    }
    const Vec3d normal = way * (1.0 / size);
    return FacePlane{normal, dot(normal, corner(plane.normal * plane.offset))};
  }
  /// Whether faces of a level plane have a coordinate exactly in common here, too.
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
  /// The length of the longest image of a mesh's unit here, or at most the square root of 3 times as much.
  double size_of_unit() const {
    const double square = sum_over<double>(world_.rows, [&](const Vec3d& row) { return dot(row, row); });
    return std::sqrt(square) * frame_.scale;
  }

 private:
  const Transform& world_;
  const GridFrame& frame_;
  Transform normals_;
};

}  // namespace dmpc::core
