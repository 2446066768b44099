// The state of a ray's traversal of the grid between two records.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "core/base/region.h"
#include "core/record/hit.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Where a ray enters a region: all that the region's owner needs, in addition to the ray, to go on with the same bits.
struct Passage {
  double t_enter = 0;
  Corner cell{};                ///< the finest cell that is entered
  std::uint8_t entry_axis = 3;  ///< axis of the plane through which it is entered; 3: the ray starts here
  Hit best;                     ///< the nearest candidate so far, beyond t_enter
};

/// Children that were met and not yet visited, the nearest last. Not initialised: that would cost as much as a step.
struct MetChildren {
  /// Each BVH node takes one child's slot and adds up to 8.
  static constexpr std::size_t count_max = bvh_levels_max * (bvh_children_max - 1) + 1;

  std::uint32_t count;
  float t_taken;  ///< t at which the ray enters the box of the child that was taken last
  std::array<BvhChild, count_max> record;
  std::array<float, count_max> t_enter;

  /// Inserts a child, whose box the ray enters at t, among those from `first` on, which stay sorted.
  void add(BvhChild child, float t, std::uint32_t first) {
    std::uint32_t place = count++;
    for (; place > first && t_enter[place - 1] < t; --place) {
      record[place] = record[place - 1];
      t_enter[place] = t_enter[place - 1];
    }
    record[place] = child;
    t_enter[place] = t;
  }
  /// Takes the last; count > 0.
  BvhChild take() {
    t_taken = t_enter[--count];
    return record[count];
  }
  /// Takes the last child whose box the ray enters at t_most or before; drops those behind it. None if there is none.
  BvhChild take_up_to(float t_most) {
    while (count > 0) {
      const BvhChild child = take();
      if (t_taken <= t_most) {
        return child;
      }
    }
    return BvhChild::none();
  }
};

/// Where a ray leaves a box of cells.
struct Exit {
  double t = 0;
  std::int32_t plane = 0;  ///< in finest cells
  std::uint8_t axis = 0;
};

/// The state of a traversal between two records. A step reads exactly one record, and whatever the next one needs is here by
/// value, so a cache of one page makes progress. Reciprocals and plane constants are pure functions of the ray and are
/// recomputed.
struct Cursor {
  Hit best;
  Address absent = no_address;       ///< the record that trace() needs next, after Traced::absent
  double t_enter = 0;                ///< t at which the ray enters the current cell
  Exit exit;                         ///< where it leaves the cell or the region; known while children are visited
  Corner cell{};                     ///< lower corner of the current macro cell, in finest cells
  Corner arrival{};                  ///< with Stage::left: the finest cell that is entered
  BvhChild next = BvhChild::none();  ///< what the next step reads, with Stage::child
  std::uint8_t entry_axis = 3;       ///< axis of the plane through which the cell was entered; 3: the traversal starts here
  /// What the next step reads: the directory entry of `cell`, or `next`.
  enum class Stage : std::uint8_t { start, directory, child, left, finished } stage = Stage::start;
  MetChildren waiting;  ///< known while children are visited
};
static_assert(std::is_trivially_copyable_v<Cursor>);

}  // namespace dmpc::core
