// Builds the bricks below one top cell: which primitives share a block, and which blocks a brick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/region.h"
#include "core/database/brick_tree.h"
#include "core/database/cut_tree.h"
#include "core/database/cutter.h"
#include "core/database/database.h"
#include "core/database/parallel.h"

namespace dmpc::core {

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
