// The traversal of the grid by one ray, one record per step.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/trace/cursor.h"
#include "core/trace/kernel.h"
#include "core/trace/operations.h"
#include "core/trace/ray_planes.h"

namespace dmpc::core {

/// Values that follow from a ray and a grid: they are recomputed from the ray's bits, not carried from step to step.
///
/// RayPlanes keep order, so "which planes has the ray crossed at t" has one answer: macro cells, empty boxes of them and
/// regions are all boxes of one lattice, and leaving a box of empty cells in one step leads to the same cell as leaving it cell
/// by cell. Planes crossed at equal t are crossed in the order x, y, z.
///
/// Within a macro cell a tree of BVH nodes leads to the leaves whose boxes the ray meets, nearest first. The cell is left when
/// none is nearer than the best hit.
class CellTraversal {
 public:
  CellTraversal(const Ray& ray, const GridFrame& frame, const Region& region);

  /// Continues in another region; recomputes only what depends on the region.
  void move_to(const Region& region);

  /// As reciprocal_direction() returns it.
  const Vec3d& reciprocal() const { return planes_.reciprocal(); }

  /// Puts the cursor on the first macro cell; false if the ray misses the grid or is not finite.
  bool enter(const Ray& ray, Cursor& cursor) const;

  /// The finest cell that a traversal which enter() has put on its first macro cell starts in.
  Corner first_cell(const Cursor& cursor) const;

  /// Takes the directory entry of the cursor's cell. Afterwards a BVH node is to be visited, or another entry is needed, or the
  /// traversal is finished (false) or has left the region (false, with Stage::left).
  bool read(const Ray& ray, const DirectoryEntry& entry, Cursor& cursor, Operations& operations) const;

  /// Leaves the cursor's cell, whose children have been visited, for one whose entry is needed, unless the traversal is finished
  /// or has left the region (false).
  bool leave_cell(const Ray& ray, Cursor& cursor, Operations& operations) const {
    return leave(ray, cursor.exit, nullptr, cursor, operations);
  }

  /// Takes a ray that enters the region in finest cell `cell` through all of it, as if it were empty. Afterwards the traversal is
  /// finished or has left the region.
  void leave_region(const Ray& ray, const Corner& cell, Cursor& cursor, Operations& operations) const;
  /// Where the ray would leave the region then, if it had no end.
  Exit region_exit() const;

 private:
  double plane(std::size_t axis, std::int32_t index) const { return planes_.plane(axis, index); }
  bool crossed(std::size_t axis, std::int32_t index, double t, std::uint8_t entry_axis) const;
  std::int32_t locate(std::size_t axis, double t, std::int32_t low, std::int32_t high, std::uint8_t entry_axis) const;
  std::int32_t locate_macro(std::size_t axis, double t, std::int32_t low, std::int32_t high, std::uint8_t entry_axis) const;
  Corner planes_ahead(const Corner& cell, std::int32_t reach, const Region& limits) const;
  Exit exit_through(const Corner& planes) const;
  bool leave(const Ray& ray, const Exit& exit, const Region* around, Cursor& cursor, Operations& operations) const;
  bool jump(const Ray& ray, std::int32_t radius, Cursor& cursor, Operations& operations) const;
  bool stays(Cursor& cursor, std::int32_t face) const;
  Corner finest_cell_of(const Cursor& cursor, std::int32_t face) const;

  RayPlanes planes_;
  Region grid_, region_;
  bool whole_;  ///< the region is the whole grid: no ray leaves it
};

// The functions that a ray needs at every step are inline, so that they form one loop with the look-up of records.

/// The planes, one per axis, through which the ray may leave the box of all cells nearer to `cell` than `reach` (in finest cells,
/// a multiple of a macro cell's) clipped to `limits`.
inline Corner CellTraversal::planes_ahead(const Corner& cell, std::int32_t reach, const Region& limits) const {
  Corner planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    planes[axis] = planes_.step(axis) > 0 ? std::min(cell[axis] + reach, limits.high[axis])
                                          : std::max(cell[axis] - reach + finest_per_macro, limits.low[axis]);
  }
  return planes;
}

/// The first plane that is crossed.
inline Exit CellTraversal::exit_through(const Corner& planes) const {
  Exit exit{std::numeric_limits<double>::infinity()};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double t = plane(axis, planes[axis]);
    if (t < exit.t) {
      exit = {t, planes[axis], static_cast<std::uint8_t>(axis)};
    }
  }
  return exit;
}

inline Exit CellTraversal::region_exit() const {
  Corner planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    planes[axis] = planes_.step(axis) > 0 ? region_.high[axis] : region_.low[axis];
  }
  return exit_through(planes);
}

inline bool CellTraversal::read(const Ray& ray, const DirectoryEntry& entry, Cursor& cursor, Operations& operations) const {
  if (!entry.empty()) {
    cursor.exit = exit_through(planes_ahead(cursor.cell, finest_per_macro, region_));
    cursor.next = BvhChild::bvh_node(entry.bvh_node());
    cursor.waiting.count = 0;
    cursor.waiting.t_taken = 0.0F;
    cursor.stage = Cursor::Stage::child;
    return true;
  }
  if (entry.radius() > 1) {
    return jump(ray, entry.radius(), cursor, operations);
  }
  const Region& limits = entry.radius() > 0 ? grid_ : region_;
  return leave(ray, exit_through(planes_ahead(cursor.cell, finest_per_macro, limits)), nullptr, cursor, operations);
}

/// Goes on to the next macro cell: the neighbour, or, from several cells `around` the cursor's, the one that holds the ray. False
/// if the traversal ends.
inline bool CellTraversal::leave(const Ray& ray, const Exit& exit, const Region* around, Cursor& cursor,
                                 Operations& operations) const {
  ++operations.cell_steps;
  // If they are equal, the next cell may hold a hit at the same t with a lower id.
  if (double{cursor.best.t} < exit.t || exit.t >= double{ray.t_max}) {
    return false;
  }
  const std::int32_t face = planes_.step(exit.axis) > 0 ? exit.plane : exit.plane - 1;
  if (face < 0 || face >= grid_.high[exit.axis]) {
    return false;
  }
  cursor.t_enter = exit.t;
  cursor.entry_axis = exit.axis;
  cursor.cell[exit.axis] = face & -finest_per_macro;
  for (std::size_t axis = 0; around != nullptr && axis < 3; ++axis) {
    if (axis != exit.axis) {
      cursor.cell[axis] = locate_macro(axis, exit.t, around->low[axis], around->high[axis], exit.axis);
    }
  }
  cursor.stage = Cursor::Stage::directory;
  return whole_ || stays(cursor, face);
}

}  // namespace dmpc::core
