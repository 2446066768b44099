// The part of a scene that is stored as instances, in place of copies.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/box.h"
#include "core/database/conversion.h"
#include "core/database/meshes/mesh_faces.h"
#include "core/database/meshes/mesh_records.h"
#include "core/database/meshes/obstacle.h"
#include "core/database/parallel.h"
#include "core/record/instance.h"
#include "core/scene/scene.h"
#include "core/scene/transform.h"

namespace dmpc::core {

/// An instance of a base mesh.
struct StoredInstance {
  Transform world;
  std::uint32_t mesh = 0;   ///< index into StoredInstances::meshes
  std::uint32_t first = 0;  ///< the id of the mesh's triangle 0 in this instance
  Bounds bounds;            ///< the copy's, grid-local
};

struct StoredInstances {
  std::vector<MeshRecords> meshes;
  std::vector<StoredInstance> places;   ///< by `first`, ascending
  std::vector<std::uint32_t> own_ids;   ///< primitives that are no copies, ascending: indices into the conversion's lists
  std::vector<std::uint32_t> reported;  ///< by index into the conversion's lists: ids
  std::uint64_t unlisted = 0;           ///< triangles of instances that have an id, but are in no list of the conversion
  ObstacleCounts copied;                ///< all other instances

  bool empty() const { return places.empty(); }
  /// An instance's record, without the mesh's address. `pad`: the grid's.
  InstanceRecord record_of(const StoredInstance& place, const GridFrame& frame, double pad) const;
};

/// Whether an instance may use a mesh with records in this unit: its boxes, widened by the grid's pad, still tell rays apart.
bool can_have_boxes(const Transform& world, const GridFrame& frame, double unit, double pad);

/// Scans `conversion`, which contains all copies and keeps them, so that ids do not depend on how they are stored; but each of
/// the mesh's triangles gets an id in every kept instance, and those that are degenerate after rounding are in the list as
/// triangles that nothing hits. Kept instances have no normals there.
StoredInstances store_instances(const Scene& scene, std::span<const MeshFaces> faces, const GridFrame& frame, double pad,
                                Conversion& conversion, const Parallel& parallel);

}  // namespace dmpc::core
