// The walk of the grid with tests of triangles of one's own: the scalar twin's, or ones that collect every hit.
#pragma once

#include <cstddef>
#include <limits>

#include "core/database.h"
#include "core/ray.h"
#include "core/traversal.h"

namespace dmpc::apps {

/// A block of primitives as a record holds it.
struct BlockView {
  core::PrimitiveKind kind{};
  std::size_t count = 0;
  const float* rows = nullptr;
  const std::uint32_t* ids = nullptr;
};

inline BlockView view_block(const std::byte* record) {
  const auto header = core::read<core::BlockHeader>(record);
  const auto* rows = reinterpret_cast<const float*>(record + sizeof(header));
  return {header.kind, header.count, rows,
          reinterpret_cast<const std::uint32_t*>(rows + core::value_count(header.kind) * header.count)};
}

/// Calls test(block, best) for each block that `ray` meets before the walk knows its nearest hit; the walk's own test of
/// triangles sees none of them, since its sheared ray is blind. Spheres and cones have but one kernel, and the walk tests them
/// itself. Returns the best of both.
template <class Test>
core::Hit walk_blocks(const core::Database& database, const core::Ray& ray, const Test& test) {
  constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
  core::Ray blind;
  blind.direction = {nothing, nothing, nothing};
  const core::ShearedRay sheared(blind);
  const core::LocalRecords records(database.bytes());
  const core::Walk walk(ray, database.header().frame, database.header().region);
  core::Cursor cursor;
  core::Operations operations;
  if (!walk.enter(ray, cursor)) {
    return {};
  }
  const std::byte* record = nullptr;
  do {
    record = records.find(record_needed(cursor, database.header()));
    if (cursor.stage == core::Cursor::Stage::block) {
      test(view_block(record), cursor.best);
    }
  } while (walk.step(ray, sheared, record, cursor, {}, operations));
  return cursor.best;
}

}  // namespace dmpc::apps
