#include "apps/foreign/polygon/indexed_counts.h"

#include "apps/foreign/polygon/indexed_mesh.h"

namespace dmpc::apps {

MeshCounts counts_of_indexed(MeshCounts counts, std::uint64_t file_bytes) {
  constexpr std::uint64_t index = sizeof(std::uint32_t), place = sizeof(IndexedMesh::Place), colour = sizeof(Color);
  const std::uint64_t of_vertex =
      (counts.has_normals ? sizeof(core::Vec3d) : 0) + (counts.has_places ? place : 0) + (counts.has_colors ? colour : 0);
  const std::uint64_t of_face = 2 * index + (counts.has_colors ? colour : 0), of_corner = counts.has_places ? place : 0;
  counts.read_bytes = file_bytes + of_vertex * counts.vertices + of_face * counts.faces + of_corner * counts.corners;
  if (counts.has_colors || counts.has_places) {
    counts.read_bytes += (sizeof(core::Vec3d) + index) * counts.vertices + index * (counts.corners + counts.faces);
  }
  return counts;
}

MeshCounts counts_of_facets(std::uint64_t facets, std::uint64_t file_bytes) {
  return counts_of_indexed({.vertices = 3 * facets, .faces = facets, .corners = 3 * facets, .triangles_min = facets}, file_bytes);
}

}  // namespace dmpc::apps
