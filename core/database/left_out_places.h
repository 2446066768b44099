// The places of a scene that leaves copies out, as instances: no copy is made on the way.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/box.h"
#include "core/database/conversion.h"
#include "core/database/kept_instances.h"
#include "core/database/mesh_chunks.h"
#include "core/database/mesh_faces.h"
#include "core/database/parallel.h"
#include "core/record/record.h"
#include "core/scene/kept_meshes.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// The scene and its faces outlive it.
class LeftOutPlaces {
 public:
  /// Nothing if a mesh that stands somewhere cannot be kept (core/database/mesh_records.h), or has a corner in some place that no
  /// grid takes. Throws RoomError if the scene has more triangles than 32 bits count.
  static std::optional<LeftOutPlaces> of(const Scene& scene, std::span<const MeshFaces> faces, const Parallel& parallel);

  /// TopCells::excess_of() of all copies, if there were any. Unless it `is_exact` it may be more than that, for which few
  /// triangles are looked at. 0 if there are so many that nobody could have copies of them.
  std::int64_t excess(const GridFrame& frame, double pad, bool is_exact, const Parallel& parallel) const;

  /// Takes what stands for places out of `conversion`. The ids of all that stays are as if there were copies, none of which
  /// rounding left nothing of. Boxes of places hold these copies, and may be a little larger than they are. Nothing, and
  /// `conversion` stays, if a place has to be copied. To be called once.
  std::optional<KeptInstances> keep(const GridFrame& frame, double pad, Conversion& conversion, const Parallel& parallel);

 private:
  LeftOutPlaces(const Scene& scene, std::span<const MeshFaces> faces) : scene_(scene), faces_(faces) {}

  bool take_meshes(const Parallel& parallel);
  bool are_usable(const Parallel& parallel) const;
  bool is_usable(const KeptPlace& place) const;
  std::int64_t excess_of(const KeptPlace& place, const GridFrame& frame, double pad, bool is_exact) const;
  Bounds bounds_of(const KeptPlace& place, const GridFrame& frame) const;
  std::uint64_t triangles_of(const KeptPlace& place) const { return faces_[place.mesh].triangles.size(); }

  const Scene& scene_;
  std::span<const MeshFaces> faces_;
  std::vector<MeshRecords> records_;  ///< of Scene::kept's meshes, as the next
  std::vector<MeshChunks> chunks_;
  std::uint64_t triangles_ = 0;  ///< of all places
};

}  // namespace dmpc::core
