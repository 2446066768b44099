#include "core/database/mesh_chunks.h"

#include <algorithm>
#include <cstddef>

namespace dmpc::core {
namespace {

/// Triangles of a group: with fewer the boxes around them fit better, and there are more of them.
constexpr std::size_t triangles_a_chunk = 16;

}  // namespace

MeshChunks::MeshChunks(const Scene& mesh, const MeshFaces& faces, std::span<const std::uint32_t> ids)
    : ids_(ids.begin(), ids.end()) {
  for (const Vec3d& vertex : mesh.vertices) {
    box_.include(vertex);
  }
  for (std::size_t first = 0; first < ids_.size(); first += triangles_a_chunk) {
    const std::size_t end = std::min(ids_.size(), first + triangles_a_chunk);
    Chunk& chunk = chunks_.emplace_back();
    chunk.first = static_cast<std::uint32_t>(first);
    chunk.end = static_cast<std::uint32_t>(end);
    for (std::size_t i = first; i < end; ++i) {
      const MeshTriangle& triangle = faces.triangles[ids_[i]];
      for (const std::uint32_t corner : triangle.corner) {
        chunk.box.include(mesh.vertices[mesh.objects[triangle.object].first + corner]);
      }
    }
  }
}

}  // namespace dmpc::core
