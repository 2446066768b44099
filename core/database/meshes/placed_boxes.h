// The boxes of BVH nodes, and those of a base mesh in one of its instances.
#pragma once

#include <cmath>
#include <cstddef>

#include "core/base/box.h"
#include "core/base/vec.h"
#include "core/record/instance.h"
#include "core/record/record.h"
#include "core/scene/placing.h"

namespace dmpc::core {

/// The box of a BVH node's child, in the coordinates of the grid or of its mesh.
inline Box box_of(const BvhNode& bvh_node, std::size_t child) {
  return {{place_of(bvh_node, 0, child), place_of(bvh_node, 1, child), place_of(bvh_node, 2, child)},
          {place_of(bvh_node, 3, child), place_of(bvh_node, 4, child), place_of(bvh_node, 5, child)}};
}

/// Boxes of the mesh's BVH nodes in the grid: around the transformed ones.
class PlacedBoxes {
 public:
  PlacedBoxes(const InstanceRecord& instance, const GridFrame& frame) : way_(instance, frame), pad_(double{instance.pad}) {}

  /// The box, grid-local, within which a ray may hit the contents of a BVH node's child: includes the grid's pad, and the
  /// rounding of its corners.
  Box box_of(const BvhNode& bvh_node, std::size_t child) const {
    const Box own = core::box_of(bvh_node, child);
    const Vec3d middle = own.center(), half = own.half() + Vec3d{pad_, pad_, pad_};
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
