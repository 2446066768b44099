// A database in parts that can be stored and put together again, by this program or another one of the same build.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/database/database.h"
#include "core/database/held_array.h"
#include "core/database/meshes/obstacle.h"

namespace dmpc::core {

/// Everything of one size.
struct DatabaseSummary {
  DatabaseHeader header;
  Structure structure = Structure::grid;
  std::uint64_t page_size = 0, page_count = 0, forest_page_count = 0, open_page_count = 0;
  std::uint32_t dropped = 0, duplicates = 0, shared_planes = 0;
  std::uint64_t references = 0;
  UniformRecordCounts records;
  std::array<std::uint64_t, obstacle_count> copied{};  ///< RecordCounts::copied
  double pad = 0;
};
static_assert(std::is_trivially_copyable_v<DatabaseSummary>);

struct DatabaseParts {
  DatabaseSummary summary;
  HeldArray<std::byte> records;  ///< the pages, and overread_bytes more
  HeldArray<PrimitiveValues> primitives;
  HeldArray<PrimitiveSource> sources;
  HeldArray<PrimitivePlane> planes;
  HeldArray<CollapsedPrimitive> collapsed;
  HeldArray<CloseFaces> close_faces;

  /// Requires the records and the primitives. Nothing is copied.
  static DatabaseParts of(const Database& database);
  /// Throws InputError, which says what of the summary is impossible: with others, no table and no page lies beyond the records.
  /// The records themselves are not read.
  Database assembled() &&;
};

}  // namespace dmpc::core
