// Where the boxes of a kept mesh lie in one of its places.
#pragma once

#include <cmath>
#include <cstddef>

#include "core/base/box.h"
#include "core/base/vec.h"
#include "core/record/instance.h"
#include "core/record/record.h"
#include "core/scene/mesh_to_grid.h"

namespace dmpc::core {

/// Of the mesh's bricks, as the grid has them: boxes around the turned ones.
class PlacedBoxes {
 public:
  PlacedBoxes(const InstanceRecord& instance, const GridFrame& frame) : way_(instance, frame), pad_(double{instance.pad}) {}

  /// Within which a ray may hit what a brick's child holds, grid-local: the grid's pad around it, and what rounds off its
  /// corners.
  Box box_of(const Brick& brick, std::size_t child) const {
    Vec3d middle, half;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = place_of(brick, axis, child), high = place_of(brick, axis + 3, child);
      middle[axis] = 0.5 * (low + high);
      half[axis] = 0.5 * (high - low) + pad_;
    }
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vec3d& row = way_.rows[axis];
      const double at = dot(row, middle) + way_.shift[axis];
      const double reach = std::fabs(row.x) * half.x + std::fabs(row.y) * half.y + std::fabs(row.z) * half.z;
      const double rounding = rounding_share * (std::fabs(at) + reach);
      box.low[axis] = at - reach - rounding;
      box.high[axis] = at + reach + rounding;
    }
    return box;
  }

 private:
  /// Corners are rounded to floats, by half of 2^-23.
  static constexpr double rounding_share = 0x1p-22;

  MeshToGrid way_;
  double pad_;
};

}  // namespace dmpc::core
