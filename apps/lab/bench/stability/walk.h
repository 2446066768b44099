// The walk of the grid with tests of triangles of one's own: the scalar twin's, or ones that collect every hit.
#pragma once

#include <cstddef>

#include "core/database/database.h"
#include "core/record/ray.h"
#include "core/trace/traversal.h"

namespace dmpc::apps {

/// A block of primitives as a record holds it.
struct BlockView {
  core::PrimitiveKind kind{};
  std::size_t count = 0;
  const float* rows = nullptr;
  const std::uint32_t* ids = nullptr;
  std::uint32_t shared_lanes = 0;
  const std::byte* record = nullptr;
};

inline BlockView view_block(const std::byte* record) {
  const auto header = core::read<core::BlockHeader>(record);
  const auto* rows = reinterpret_cast<const float*>(record + sizeof(header));
  return {header.kind,         header.count, rows, reinterpret_cast<const std::uint32_t*>(core::ids_of(header, record)),
          header.shared_lanes, record};
}

/// Calls test(block, best) for each block of triangles that `ray` meets, by `meet`, before the walk knows its nearest hit.
/// Spheres and cones have but one kernel, which tests them. Returns the best of both.
template <class Test>
core::Hit walk_blocks(const core::Database& database, const core::Ray& ray, core::BrickKernel meet, const Test& test) {
  const core::ShearedRay sheared(ray);
  core::LocalRecords records(database.bytes());
  core::Cursor cursor;
  core::Operations operations;
  const auto test_any = [&](const std::byte* record, core::Address address, core::Hit& best) {
    const BlockView block = view_block(record);
    if (block.kind == core::PrimitiveKind::triangle) {
      test(block, best);
    } else {
      core::test_block(ray, sheared, record, address, best, operations);
    }
  };
  core::RayWalk(ray, cursor, records, operations).trace(database.header(), {}, meet, test_any);
  return cursor.best;
}

}  // namespace dmpc::apps
