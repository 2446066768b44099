// trace(ray, cursor, records): hit, miss, or absent record r; resumable at every record, with the same bits.
#pragma once

#include "core/walk.h"
#include "core/records.h"

namespace dmpc::core {

enum class Traced : std::uint8_t { hit, miss, absent };

/// The answer of a walk that has ended.
inline Traced finish(Cursor& cursor) {
  cursor.stage = Cursor::Stage::finished;
  return cursor.best.found() ? Traced::hit : Traced::miss;
}

/// Walks `ray` through the grid until its nearest hit in (0, ray.t_max) is known (for a shadow ray: any hit), no hit can exist,
/// or a record is absent. After Traced::absent, call again with the same cursor once the record of cursor.absent is there: the
/// answer has the same bits as without the interruption. A ray with a NaN or an infinite component misses.
/// Source: J. Amanatides, A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987, over nested 4^3 bricks.
template <Records R>
Traced trace(const Ray& ray, Cursor& cursor, R& records, const DatabaseHeader& header, const TraversalOptions& options,
             Operations& operations) {
  if (cursor.stage == Cursor::Stage::finished) {
    return finish(cursor);
  }
  const Walk walk(ray, header.frame);
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
