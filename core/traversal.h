// trace(ray, cursor, records): hit, miss, or absent record r; resumable at every record, with the same bits.
#pragma once

#include <optional>

#include "core/records.h"
#include "core/walk.h"

namespace dmpc::core {

enum class Traced : std::uint8_t { hit, miss, absent, left };

/// The answer of a walk that has ended or has left its region.
inline Traced finish(Cursor& cursor) {
  if (cursor.stage == Cursor::Stage::left) {
    return Traced::left;
  }
  cursor.stage = Cursor::Stage::finished;
  return cursor.best.found() ? Traced::hit : Traced::miss;
}

/// Where the ray goes on, after Traced::left.
inline Passage passage_of(const Cursor& cursor) { return {cursor.t_enter, cursor.arrival, cursor.entry_axis, cursor.best}; }

/// The cursor of a walk that enters a region.
inline Cursor arrive(const Passage& passage) {
  Cursor cursor;
  cursor.best = passage.best;
  cursor.t_enter = passage.t_enter;
  cursor.entry_axis = passage.entry_axis;
  cursor.arrived = true;
  cursor.arrival = passage.cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cursor.cell[axis] = passage.cell[axis] & -finest_per_top;
  }
  cursor.stage = Cursor::Stage::directory;
  return cursor;
}

/// Where a ray's walk begins; nothing if it misses the grid.
inline std::optional<Passage> first_passage(const Ray& ray, const GridFrame& frame) {
  const Walk walk(ray, frame, {.high = grid_size(frame)});
  Cursor cursor;
  if (!walk.enter(ray, cursor)) {
    return std::nullopt;
  }
  return Passage{.t_enter = cursor.t_enter, .cell = walk.first_cell(cursor)};
}

/// What trace() would answer from `passage` on in a region that has no records, without reading any. After Traced::left `passage`
/// is where the ray goes on, else where it was.
inline Traced pass(const Ray& ray, const GridFrame& frame, const Region& region, Passage& passage, Operations& operations) {
  Cursor cursor = arrive(passage);
  Walk(ray, frame, region).leave_region(ray, cursor, operations);
  const Traced traced = finish(cursor);
  if (traced == Traced::left) {
    passage = passage_of(cursor);
  }
  return traced;
}

/// Walks `ray` through the grid until its nearest hit in (0, ray.t_max) is known (for a shadow ray: any hit), no hit can exist,
/// or a record is absent. After Traced::absent, call again with the same cursor once the record of cursor.absent is there: the
/// answer has the same bits as without the interruption. Where `header` is a region's, a ray that leaves the region answers
/// Traced::left, and whoever owns the cell of passage_of(cursor) goes on from arrive(), with the same bits. A ray with a NaN or
/// an infinite component misses. Source: J. Amanatides, A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987, over
/// nested 4^3 bricks.
template <Records R>
Traced trace(const Ray& ray, Cursor& cursor, R& records, const DatabaseHeader& header, const TraversalOptions& options,
             Operations& operations) {
  if (cursor.stage == Cursor::Stage::finished) {
    return finish(cursor);
  }
  const Walk walk(ray, header.frame, header.region);
  if (cursor.stage == Cursor::Stage::start && !walk.enter(ray, cursor)) {
    return finish(cursor);
  }
  const ShearedRay sheared(ray);
  for (;;) {
    const Address next = record_needed(cursor, header);
    const std::byte* record = records.find(next);
    if (record == nullptr) {
      cursor.absent = next;
      return Traced::absent;
    }
    if (!walk.step(ray, sheared, record, cursor, options, operations)) {
      return finish(cursor);
    }
  }
}

}  // namespace dmpc::core
