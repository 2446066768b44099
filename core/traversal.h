// trace(ray, cursor, records): hit, miss, or absent record r; resumable at every record, with the same bits.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "core/hit.h"
#include "core/operations.h"
#include "core/ray.h"
#include "core/record.h"
#include "core/records.h"

namespace dmpc::core {

enum class Traced : std::uint8_t { hit, miss, absent };

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
  float t_enter = 0;
  std::array<std::int32_t, 3> cell{};      ///< lower corner of the current cell, in finest cells
  std::array<Level, finest_level> path;    ///< path[l]: the brick whose voxels are the cells of level l + 1
  std::array<Address, blocks_per_sheet> blocks{};  ///< still to be tested in the current voxel
  Address sheet = no_address;              ///< the sheet of the current voxel to be read next
  std::uint8_t block_count = 0;
  std::uint8_t level = 0;                  ///< of the current cell
  std::uint8_t entry_axis = 3;             ///< through which plane the cell was entered; 3: the walk starts here
  enum class Stage : std::uint8_t { start, cell, sheet, blocks, finished } stage = Stage::start;
};
static_assert(std::is_trivially_copyable_v<Cursor>);

/// What a caller may switch off to see what it contributes. Every switch is exact: it does not change a bit of the result.
struct TraversalOptions {
  bool skip_empty_space = true;  ///< leave empty boxes of top cells in one step
};

/// Walks `ray` through the grid until its nearest hit in (0, ray.t_max) is known (for a shadow ray: any hit), no hit can exist,
/// or a record is absent. After Traced::absent, call again with the same cursor once the record of cursor.absent is there: the
/// answer has the same bits as without the interruption. A ray with a NaN or an infinite component misses.
/// Source: J. Amanatides, A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987, over nested 4^3 bricks.
template <Records R>
Traced trace(const Ray& ray, Cursor& cursor, R& records, const DatabaseHeader& header, const TraversalOptions& options,
             Operations& operations);

}  // namespace dmpc::core
