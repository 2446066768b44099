// The instances of a scene that leaves copies out: no copies are made on the way.
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
  /// Requires that instances whose copies the scene leaves out have no obstacle (core/database/meshes/obstacle.h). Throws
  /// CapacityError if it has more triangles than 32 bits count.
  UncopiedInstances(const Scene& scene, std::span<const MeshFaces> faces, const Parallel& parallel);

  /// More than any list can hold.
  static constexpr std::int64_t excess_without_list = std::int64_t{1} << 48U;
  /// MacroCells::excess_of() all copies, if there were any. Unless it `is_exact` it may be more than that, for which few
  /// triangles are tested. Once it is certain that there is no list of these and `listed` other primitives, it is
  /// excess_without_list in either case. 0 if there are too many for copies.
  std::int64_t excess(const GridFrame& frame, double pad, std::uint64_t listed, bool is_exact, const Parallel& parallel) const;

  /// Instances that this pad makes too small, one entry for each of Scene::kept.
  std::vector<Obstacle> obstacles(const GridFrame& frame, double pad) const;

  /// Takes the stand-ins for instances out of `conversion`. The ids of all that stays are as if there were copies, none of which
  /// is degenerate after rounding. Boxes of instances hold these copies, and may be a little larger. Requires that there are no
  /// obstacles(). To be called once.
  StoredInstances keep(const GridFrame& frame, double pad, Conversion& conversion, const Parallel& parallel);

 private:
  /// Nearby triangles of a mesh, to test its instances without testing each corner.
  struct Chunk {
    Box box;  ///< around their corners, in the mesh's coordinates
    std::vector<std::uint32_t> triangles;
  };
  /// Touches of cells by a copy's triangles; more than `touches_max` if those that were tested touch more.
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
  std::vector<BaseMeshInstance> instances_;  ///< without copies
  MeshesRecords meshes_;
  std::vector<std::vector<Chunk>> chunks_;  ///< by MeshesRecords::index
  std::uint64_t triangles_ = 0;             ///< in all these instances
};

}  // namespace dmpc::core
