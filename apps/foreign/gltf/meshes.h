// The meshes of a glTF document, one for each primitive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "apps/foreign/gltf/materials.h"
#include "apps/foreign/gltf/primitive.h"
#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/mesh/scene_totals.h"

namespace dmpc::apps::gltf {

/// Which joints of a skin hold the vertices of a mesh, by how much: sets of four for each vertex.
struct Influences {
  std::vector<Values> joints, weights;  ///< as many sets
};

struct PrimitiveMesh {
  PolygonMesh mesh;              ///< triangles, by vertex; nothing of points and lines
  Influences influences;         ///< without sets if no skin holds it
  std::uint64_t thin_faces = 0;  ///< points and lines
  bool has_several_places = false, has_targets = false;
};

struct Meshes {
  std::vector<std::pair<std::size_t, std::size_t>>
      ranges;  ///< per mesh of the document: its first primitive, one past its last
  std::vector<PrimitiveMesh> list;
  std::uint64_t corners_left_over = 0;  ///< in lists whose length is no multiple of three
};

/// With places on the textures of `materials`, of which the last is that of primitives without one. Throws core::InputError, by
/// its place in the document; core::CapacityError if they take more than there is room for.
Meshes read_meshes(const Document& document, Buffers& buffers, Accessors& accessors, const std::vector<MaterialTraits>& materials,
                   SceneTotals& totals);

}  // namespace dmpc::apps::gltf
