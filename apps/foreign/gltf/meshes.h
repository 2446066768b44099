// The meshes of a glTF document, one per primitive.
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

/// The joints of a skin that move a mesh's vertices, and their weights: sets of four per vertex.
struct Influences {
  std::vector<Values> joints, weights;  ///< equal numbers of sets
};

struct PrimitiveMesh {
  PolygonMesh mesh;              ///< triangles with vertex data; empty for points and lines
  Influences influences;         ///< empty without a skin
  std::uint64_t thin_faces = 0;  ///< points and lines
  bool has_several_places = false, has_targets = false;
};

struct Meshes {
  std::vector<std::pair<std::size_t, std::size_t>> ranges;  ///< per mesh of the document: its first primitive, one past its last
  std::vector<PrimitiveMesh> list;
  std::uint64_t corners_left_over = 0;  ///< in lists whose length is no multiple of three
};

/// Reads the meshes with the texture coordinates that `materials` need; the last of these is for primitives without one. Throws
/// core::InputError, with the place in the document; core::CapacityError if they exceed the memory.
Meshes read_meshes(const Document& document, Buffers& buffers, Accessors& accessors, const std::vector<MaterialTraits>& materials,
                   SceneTotals& totals);

}  // namespace dmpc::apps::gltf
