#include "core/database/mesh_chunks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dmpc::core {
namespace {

/// Triangles of a group: with fewer the boxes around them fit better, and there are more of them. 128 fit well; a large mesh,
/// which stands in few places, has as many groups as a group has triangles.
std::size_t triangles_a_chunk(std::size_t count) {
  const auto root = static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
  return std::max(std::size_t{16}, std::min(count / 128, root));
}

}  // namespace

MeshChunks::MeshChunks(const Scene& mesh, const MeshFaces& faces, std::span<const std::uint32_t> ids)
    : ids_(ids.begin(), ids.end()) {
  const std::size_t step = triangles_a_chunk(ids_.size());
  for (std::size_t first = 0; first < ids_.size(); first += step) {
    const std::size_t end = std::min(ids_.size(), first + step);
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
