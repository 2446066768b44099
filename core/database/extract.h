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

/// Records and table of contents of one region, or of several that share what they have in common; position-independent like the
/// whole database's. trace() on it answers the same bits as on the whole while the ray is in the region that the header says.
struct DatabasePart {
  DatabaseHeader header;         ///< header.region is the region, the first of several
  std::vector<std::byte> bytes;  ///< overread_bytes more than the records take
  std::size_t record_bytes = 0;  ///< the size of the records alone, also when `bytes` are forgotten
  /// Lanes of its leaves except for those of base meshes, whose places count: summed over all parts and divided by the whole's, the
  /// duplication.
  std::uint64_t primitive_copies = 0;
  std::vector<bool> holds;  ///< by region, in the order asked for: whether a leaf's box touches it
};

/// Copies the directory's entries, BVH nodes, leaves and normals that cells in `regions`, one or more, need, each once; all
/// materials, lights and emitters, and of textures the tiles that the triangles there may show; addresses are made anew, values
/// keep their bits. Of base meshes it copies what any of their places brings to the regions, each record once. A
/// leaf whose box reaches beyond each of the regions gets a name, the same in every part. Children whose boxes do not touch any
/// of the regions are left out of their BVH nodes.
DatabasePart extract(const Database& database, std::span<const Region> regions);
inline DatabasePart extract(const Database& database, const Region& region) { return extract(database, std::span(&region, 1)); }

/// What extract() answers except for the bytes, which are not copied: there are none.
DatabasePart measure_part(const Database& database, std::span<const Region> regions);

}  // namespace dmpc::core
