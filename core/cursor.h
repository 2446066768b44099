// Where a ray is on its way through the grid, between two records.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "core/hit.h"
#include "core/record.h"
#include "core/region.h"

namespace dmpc::core {

/// Where a ray enters a region on its way: all that the region's owner needs, beside the ray, to go on with the same bits.
struct Passage {
  double t_enter = 0;
  Corner cell{};                ///< the finest cell that is entered
  std::uint8_t entry_axis = 3;  ///< through which plane; 3: the ray starts here
  Hit best;                     ///< the nearest candidate so far, beyond t_enter
};

/// The state of a walk between two records. A step reads exactly one record, and whatever the next one needs is here by value, so
/// a cache of one page makes progress. Reciprocals and plane constants are pure functions of the ray and are recomputed.
struct Cursor {
  /// One brick on the path from the top cell to the current cell.
  struct Level {
    std::uint64_t occupied = 0;
    Address brick = no_address;
    std::uint8_t tested = 0;  ///< blocks of the first sheet that this ray has been tested against
  };

  Hit best;
  Address absent = no_address;  ///< the record that trace() needs next, after Traced::absent
  double t_enter = 0;
  std::array<std::int32_t, 3> cell{};              ///< lower corner of the current cell, in finest cells
  std::array<Level, finest_level> path;            ///< path[l]: the brick whose voxels are the cells of level l + 1
  std::array<Address, blocks_per_sheet> blocks{};  ///< still to be tested in the current voxel, the last first
  Address sheet = no_address;                      ///< the sheet of the current voxel to be read next
  std::uint8_t block_count = 0;
  std::uint8_t level = 0;       ///< of the current cell
  std::uint8_t entry_axis = 3;  ///< through which plane the cell was entered; 3: the walk starts here
  /// What the next step reads: the directory entry of `cell`, the brick path[level], `sheet`, or the last of `blocks`.
  enum class Stage : std::uint8_t { start, directory, brick, sheet, block, left, finished } stage = Stage::start;
  bool arrived = false;  ///< the walk has not left the finest cell `arrival` yet, in which it entered the region
  Corner arrival{};      ///< the finest cell entered: this region's, or, with Stage::left, the next one's
};
static_assert(std::is_trivially_copyable_v<Cursor>);

}  // namespace dmpc::core
