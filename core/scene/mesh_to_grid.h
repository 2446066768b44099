// The way of a kept mesh's records into the grid.
#pragma once

#include <array>
#include <cstddef>

#include "core/base/vec.h"
#include "core/record/instance.h"
#include "core/record/record.h"
#include "core/scene/frame.h"
#include "core/scene/transform.h"

namespace dmpc::core {

inline Transform transform_of(const InstanceRecord& instance) {
  const auto& world = instance.world;
  return {.rows = {{{world[0], world[1], world[2]}, {world[3], world[4], world[5]}, {world[6], world[7], world[8]}}},
          .shift = {world[9], world[10], world[11]}};
}

/// By columns, of a linear part that can_be_kept().
inline std::array<Vec3d, 3> inverse_of(const std::array<Vec3d, 3>& rows) {
  const double share = 1 / dot(rows[0], cross(rows[1], rows[2]));
  return {cross(rows[1], rows[2]) * share, cross(rows[2], rows[0]) * share, cross(rows[0], rows[1]) * share};
}

/// The linear part of the way into the grid from a mesh's records, which have this unit.
inline std::array<Vec3d, 3> rows_in_grid(const Transform& world, double unit, const GridFrame& frame) {
  std::array<Vec3d, 3> rows;
  for (std::size_t row = 0; row < 3; ++row) {
    rows[row] = world.rows[row] * (unit * frame.scale);
  }
  return rows;
}

/// For boxes, in double: rows m + shift of a point m in units of the mesh's records. Corners of triangles are placed by Placing
/// (core/scene/placing.h), in another order of operations.
struct MeshToGrid {
  MeshToGrid(const InstanceRecord& instance, const GridFrame& frame)
      : rows(rows_in_grid(transform_of(instance), double{instance.unit}, frame)),
        shift(to_local(frame, transform_of(instance).shift)) {}

  std::array<Vec3d, 3> rows;
  Vec3d shift;
};

}  // namespace dmpc::core
