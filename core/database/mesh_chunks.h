// A mesh's triangles in small groups that lie together, to look at its places without a look at each corner.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/box.h"
#include "core/database/mesh_faces.h"
#include "core/scene/scene.h"

namespace dmpc::core {

class MeshChunks {
 public:
  struct Chunk {
    Box box;                           ///< of the corners of its triangles, in the mesh's coordinates
    std::uint32_t first = 0, end = 0;  ///< of ids(): from the one to before the other
  };

  /// `ids`: all of the mesh's triangles, those that lie together one after the other (BrickTree::ids).
  MeshChunks(const Scene& mesh, const MeshFaces& faces, std::span<const std::uint32_t> ids);

  std::span<const Chunk> chunks() const { return chunks_; }
  std::span<const std::uint32_t> ids(const Chunk& chunk) const {
    return std::span(ids_).subspan(chunk.first, chunk.end - chunk.first);
  }

 private:
  std::vector<Chunk> chunks_;
  std::vector<std::uint32_t> ids_;
};

}  // namespace dmpc::core
