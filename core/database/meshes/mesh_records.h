// The records of a base mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/database/conversion.h"
#include "core/database/meshes/mesh_faces.h"
#include "core/database/parallel.h"
#include "core/database/tree/bvh_tree.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// In units of the mesh's coordinates, which are exact in floats, with normals as in the file.
struct MeshRecords {
  Conversion conversion;  ///< ids as in MeshFaces::triangles
  double unit = 1;        ///< a power of two
  BvhTree tree;
};

/// Requires that there is no obstacle (obstacle_of()). `materials`: those of its objects' indices.
MeshRecords records_of(const Scene& mesh, std::span<const Material> materials, const MeshFaces& faces, const Parallel& parallel);

/// Records of some of a scene's base meshes.
struct MeshesRecords {
  static constexpr std::uint32_t nowhere = 0xffffffffU;

  std::vector<MeshRecords> records;
  std::vector<std::uint32_t> index;  ///< by mesh number: index of its records, or nowhere
};

/// For the meshes that are kept in some of these instances, one entry for each of Scene::kept.
MeshesRecords records_of(const Scene& scene, std::span<const MeshFaces> faces, const std::vector<bool>& places,
                         const Parallel& parallel);

}  // namespace dmpc::core
