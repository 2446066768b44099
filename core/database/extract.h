// The part of a database that touches some regions: what a node of dataflow holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/database/database.h"
#include "core/record/record.h"
#include "core/record/records.h"

namespace dmpc::core {

/// Records and table of contents of one region, or of several that share common records; position-independent like the whole
/// database. trace() on it returns the same bits as on the whole while the ray is in the header's region.
struct DatabasePart {
  DatabaseHeader header;         ///< header.region is the region, or the first of several
  std::vector<std::byte> bytes;  ///< overread_bytes more than the records
  std::size_t record_bytes = 0;  ///< the size of the records, also after `bytes` are freed
  /// Lanes of its leaves, where for base meshes the instances count: the sum over all parts, divided by the whole's, is the
  /// duplication.
  std::uint64_t primitive_copies = 0;
  std::vector<bool> holds;  ///< by region, in the order of the request: whether a leaf's box touches it
};

/// Copies the directory's entries, BVH nodes, leaves and normals that cells in `regions`, one or more, need, each once; all
/// materials, lights and emitters, and the tiles of textures that the triangles there may show. Addresses are new, values keep
/// their bits. Of base meshes it copies what any of their instances needs in the regions, each record once. A leaf whose box
/// reaches beyond each of the regions gets a name, the same in every part. Children whose boxes touch none of the regions are
/// removed from their BVH nodes.
DatabasePart extract(const Database& database, std::span<const Region> regions);
inline DatabasePart extract(const Database& database, const Region& region) { return extract(database, std::span(&region, 1)); }

/// The result of extract() without the bytes, which are not copied.
DatabasePart measure_part(const Database& database, std::span<const Region> regions);

}  // namespace dmpc::core
