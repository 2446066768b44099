// Builds the BVH nodes below one macro cell.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/box.h"
#include "core/base/region.h"
#include "core/database/database.h"
#include "core/database/parallel.h"
#include "core/database/tree/bvh_tree.h"
#include "core/database/tree/cut_tree.h"
#include "core/database/tree/cutter.h"
#include "core/record/record.h"

namespace dmpc::core {

inline constexpr std::uint32_t bvh_node_bound_max = 255;

/// A BVH node without children that can hold groups within `bounds`, padded.
inline BvhNode bvh_node_over(const Bounds& bounds, double pad) {
  BvhNode bvh_node;
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bvh_node.origin[axis] = rounded_down(double{bounds.low[axis]} - pad);
    size = std::max(size, double{bounds.high[axis]} + pad - double{bvh_node.origin[axis]});
  }
  int exponent = 0;
  std::frexp(size / bvh_node_bound_max, &exponent);
  bvh_node.unit = std::ldexp(1.0F, exponent);
  return bvh_node;
}

/// Adds a child, whose box, padded, the BVH node can hold.
inline void add_child(BvhNode& bvh_node, const Bounds& bounds, double pad) {
  const std::size_t child = bvh_node.child_count++;
  const double unit = double{bvh_node.unit};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double origin = double{bvh_node.origin[axis]};
    bvh_node.bounds[axis][child] = static_cast<std::uint8_t>((double{bounds.low[axis]} - pad - origin) / unit);
    bvh_node.bounds[axis + 3][child] = static_cast<std::uint8_t>(std::ceil((double{bounds.high[axis]} + pad - origin) / unit));
  }
}

/// Trees of BVH nodes with a maximum number of levels, by the surface area heuristic: the probability that a ray meets a box is
/// proportional to its surface (J. D. MacDonald, K. S. Booth, "Heuristics for Ray Tracing Using Space Subdivision", 1990). Thread
/// safety: several macro cells may be built at the same time.
class BvhBuilder {
 public:
  /// The primitives and `parallel`, which is used for large cells, outlive the builder. `levels_max`: 2 to bvh_levels_max.
  BvhBuilder(std::span<const PrimitiveValues> primitives, double pad, const GridFrame& frame, const Parallel& parallel,
             int levels_max = bvh_levels_max);

  /// The BVH nodes of the macro cell at `corner`; `ids`, at least one and ascending, are the primitives that touch it. Throws
  /// CapacityError for more than 8^levels_max.
  BvhTree build(const Corner& corner, std::span<const std::uint32_t> ids) const;

 private:
  class Drafter;

  Bounds cell_at(const Corner& corner) const;
  CutTree cut(std::span<const Group> kinds, Cutter& cutter) const;
  std::vector<Group> add_by_kind(const Bounds& cell, std::span<const std::uint32_t> ids, Cutter& cutter) const;

  std::span<const PrimitiveValues> primitives_;
  double pad_;
  GridFrame frame_;
  const Parallel* parallel_;
  int levels_max_;
};

}  // namespace dmpc::core
