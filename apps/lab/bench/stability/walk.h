// The grid's traversal with a given triangle test: the scalar twin's, or one that collects every hit.
#pragma once

#include <cstddef>

#include "core/database/database.h"
#include "core/record/ray.h"
#include "core/trace/traversal.h"

namespace dmpc::apps {

/// A leaf of primitives as stored in a record.
struct LeafView {
  core::PrimitiveKind kind{};
  std::size_t count = 0;
  const float* rows = nullptr;
  const std::uint32_t* ids = nullptr;
  std::uint32_t shared_lanes = 0;
  const std::byte* record = nullptr;
};

inline LeafView view_leaf(const std::byte* record) {
  const auto header = core::read<core::LeafHeader>(record);
  const auto* rows = reinterpret_cast<const float*>(record + sizeof(header));
  return {header.kind,         header.count, rows, reinterpret_cast<const std::uint32_t*>(core::ids_of(header, record)),
          header.shared_lanes, record};
}

/// Calls test(leaf, best) for each leaf of triangles that `ray` meets, found by `meet`, before the traversal knows its nearest
/// hit. Spheres and cones have only one kernel, which tests them. Returns the best of both.
template <class Test>
core::Hit walk_leaves(const core::Database& database, const core::Ray& ray, core::BvhNodeKernel meet, const Test& test) {
  const core::ShearedRay sheared(ray);
  core::LocalRecords records(database.bytes());
  core::Cursor cursor;
  core::Operations operations;
  const auto test_any = [&](const std::byte* record, core::Address address, core::Hit& best) {
    const LeafView leaf = view_leaf(record);
    if (leaf.kind == core::PrimitiveKind::triangle) {
      test(leaf, best);
    } else {
      core::test_leaf(ray, sheared, record, address, best, operations);
    }
  };
  core::RayTraversal(ray, cursor, records, operations).trace(database.header(), {}, meet, test_any);
  return cursor.best;
}

}  // namespace dmpc::apps
