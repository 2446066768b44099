// What files of an IndexedMesh say that they have, and what reading them takes.
#pragma once

#include <cstdint>

#include "apps/formats/mesh_counts.h"

namespace dmpc::apps {

/// `counts` has all but what is read and kept. The file, of so many bytes, stays until its meshes are made: with what vertices
/// and faces have of their own, and with a second copy where faces have several materials, as coloured ones do.
MeshCounts counts_of_indexed(MeshCounts counts, std::uint64_t file_bytes);

/// Of triangles that share no vertex.
MeshCounts counts_of_facets(std::uint64_t facets, std::uint64_t file_bytes);

}  // namespace dmpc::apps
