// The triangles of a base mesh that all of its instances share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/database/database.h"
#include "core/database/parallel.h"
#include "core/scene/placing.h"
#include "core/scene/scene.h"

namespace dmpc::core {

struct MeshTriangle {
  std::uint32_t object = 0;               ///< index in the mesh
  std::array<std::uint32_t, 3> corner{};  ///< corners of that object
  std::uint32_t plane = 0;                ///< which of MeshFaces::planes it shares, from 1 on; 0: none
};

/// A mesh by itself: the result of settle_coplanar().
struct MeshFaces {
  std::vector<MeshTriangle> triangles;  ///< in the order of their ids
  std::vector<MeshPlane> planes;
  // What its instances count and report, in the mesh's coordinates:
  std::vector<CollapsedPrimitive> collapsed;
  std::vector<CloseFaces> close_faces;
  std::uint32_t dropped = 0, duplicates = 0, shared_planes = 0;
};

/// Judges a mesh in a grid of its own, as if it were a scene, so that nothing depends on where its instances are. `materials`:
/// those of its objects' indices.
MeshFaces faces_of_mesh(const Scene& mesh, std::span<const Material> materials, double cells_per_primitive,
                        const Parallel& parallel);

/// For all base meshes, in their order.
std::vector<MeshFaces> faces_of_meshes(const Scene& scene, double cells_per_primitive, const Parallel& parallel);

}  // namespace dmpc::core
