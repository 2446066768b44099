// Builds the bricks below one top cell: which primitives share a block, and which blocks a brick.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/box.h"
#include "core/base/region.h"
#include "core/database/brick_tree.h"
#include "core/database/cut_tree.h"
#include "core/database/cutter.h"
#include "core/database/database.h"
#include "core/database/parallel.h"
#include "core/record/record.h"

namespace dmpc::core {

inline constexpr std::uint32_t brick_bound_max = 255;

/// A brick without children that can hold groups within `bounds`, padded.
inline Brick brick_over(const Bounds& bounds, double pad) {
  Brick brick;
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    brick.origin[axis] = rounded_down(double{bounds.low[axis]} - pad);
    size = std::max(size, double{bounds.high[axis]} + pad - double{brick.origin[axis]});
  }
  int exponent = 0;
  std::frexp(size / brick_bound_max, &exponent);
  brick.unit = std::ldexp(1.0F, exponent);
  return brick;
}

/// The next child, whose box, padded, such a brick can hold.
inline void add_child(Brick& brick, const Bounds& bounds, double pad) {
  const std::size_t child = brick.child_count++;
  const double unit = double{brick.unit};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double origin = double{brick.origin[axis]};
    brick.bounds[axis][child] = static_cast<std::uint8_t>((double{bounds.low[axis]} - pad - origin) / unit);
    brick.bounds[axis + 3][child] = static_cast<std::uint8_t>(std::ceil((double{bounds.high[axis]} + pad - origin) / unit));
  }
}

/// Trees of bricks of at most so many levels, by the surface area heuristic: a ray meets a box in proportion to its surface
/// (J. D. MacDonald, K. S. Booth, "Heuristics for Ray Tracing Using Space Subdivision", 1990). Thread safety: several top cells
/// may be built at the same time.
class BrickBuilder {
 public:
  /// The primitives and `parallel`, which builds large cells, outlive the builder. `levels_max`: 2 to brick_levels_max.
  BrickBuilder(std::span<const PrimitiveValues> primitives, double pad, const GridFrame& frame, const Parallel& parallel,
               int levels_max = brick_levels_max);

  /// The bricks of the top cell at `corner`; `ids`, at least one and ascending, are the primitives that touch it. Throws
  /// RoomError for more than 8^levels_max.
  BrickTree build(const Corner& corner, std::span<const std::uint32_t> ids) const;

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
