// The places of a scene that leaves copies out, as instances: no copy is made on the way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/box.h"
#include "core/database/conversion.h"
#include "core/database/meshes/mesh_faces.h"
#include "core/database/meshes/mesh_records.h"
#include "core/database/meshes/obstacle.h"
#include "core/database/meshes/stored_instances.h"
#include "core/database/parallel.h"
#include "core/record/record.h"
#include "core/scene/base_meshes.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// The scene and its faces outlive it.
class UncopiedInstances {
 public:
  /// Requires that nothing is in the way (core/database/meshes/obstacle.h) of those places whose copies the scene leaves out.
  /// Throws CapacityError if it has more triangles than 32 bits count.
  UncopiedInstances(const Scene& scene, std::span<const MeshFaces> faces, const Parallel& parallel);

  /// More than any list has room for.
  static constexpr std::int64_t excess_without_list = std::int64_t{1} << 48U;
  /// MacroCells::excess_of() all copies, if there were any. Unless it `is_exact` it may be more than that, for which few
  /// triangles are looked at. Once it is known that there is no list of these and `listed` primitives beside them, however exact,
  /// it is excess_without_list. 0 if there are so many that nobody could have copies of them.
  std::int64_t excess(const GridFrame& frame, double pad, std::uint64_t listed, bool is_exact, const Parallel& parallel) const;

  /// Those that this pad makes too small, one entry for each of Scene::kept.
  std::vector<Obstacle> obstacles(const GridFrame& frame, double pad) const;

  /// Takes what stands for places out of `conversion`. The ids of all that stays are as if there were copies, none of which
  /// rounding left nothing of. Boxes of places hold these copies, and may be a little larger than they are. Requires that there
  /// are no obstacles(). To be called once.
  StoredInstances keep(const GridFrame& frame, double pad, Conversion& conversion, const Parallel& parallel);

 private:
  /// Triangles of a mesh that lie together, to look at its places without a look at each corner.
  struct Chunk {
    Box box;  ///< of their corners, in the mesh's coordinates
    std::vector<std::uint32_t> triangles;
  };
  /// That a copy's triangles touch cells; more than `touches_max` if those that are looked at touch more.
  struct Touches {
    std::uint64_t triangles = 0, touches = 0;
  };
  Touches touches_of(const BaseMeshInstance& place, const GridFrame& frame, double pad, std::uint64_t touches_max,
                     bool is_exact) const;
  Bounds bounds_of(const BaseMeshInstance& place, const GridFrame& frame) const;
  std::vector<Chunk> chunks_of(std::size_t mesh) const;
  std::uint64_t triangles_of(const BaseMeshInstance& place) const { return faces_[place.mesh].triangles.size(); }
  std::uint32_t index_of(const BaseMeshInstance& place) const { return meshes_.index[place.mesh]; }

  const Scene& scene_;
  std::span<const MeshFaces> faces_;
  std::vector<BaseMeshInstance> instances_;  ///< whose copies are left out
  MeshesRecords meshes_;
  std::vector<std::vector<Chunk>> chunks_;  ///< by MeshesRecords::index
  std::uint64_t triangles_ = 0;             ///< of all these places
};

}  // namespace dmpc::core
