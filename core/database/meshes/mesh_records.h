// A base mesh as its records hold it.
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

/// In units of the mesh's coordinates, which floats hold exactly, with normals as the file has them.
struct MeshRecords {
  Conversion conversion;  ///< ids as in MeshFaces::triangles
  double unit = 1;        ///< a power of two
  BvhTree tree;
};

/// Requires that nothing is in the way (obstacle_of()). `materials`: what its objects' indices are of.
MeshRecords records_of(const Scene& mesh, std::span<const Material> materials, const MeshFaces& faces, const Parallel& parallel);

/// Of some of a scene's base meshes.
struct MeshesRecords {
  static constexpr std::uint32_t nowhere = 0xffffffffU;

  std::vector<MeshRecords> records;
  std::vector<std::uint32_t> index;  ///< by the number of the mesh: of its records, or nowhere
};

/// Of those that are kept in some of these places, one entry for each of Scene::kept.
MeshesRecords records_of(const Scene& scene, std::span<const MeshFaces> faces, const std::vector<bool>& places,
                         const Parallel& parallel);

}  // namespace dmpc::core
