// The meshes of a glTF document as Assimp's, one for each primitive.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "apps/foreign/gltf/primitive.h"
#include "apps/foreign/mesh/imported_file.h"

namespace dmpc::apps::gltf {

/// Which joints of a skin hold the vertices of a mesh, by how much: sets of four for each vertex.
struct Influences {
  std::vector<Values> joints, weights;  ///< as many sets
};

struct Meshes {
  std::vector<std::pair<unsigned, unsigned>> ranges;  ///< of each mesh of the document: the scene's first and one past its last
  std::vector<Influences> influences;                 ///< of each of the scene's meshes; without sets if no skin holds it
  std::uint64_t corners_left_over = 0;                ///< of lists whose length is no multiple of three
};

/// Gives the file's scene its meshes, which refer to materials that it has. Throws core::InputError, by its place in the
/// document.
Meshes add_meshes(const Document& document, Buffers& buffers, ImportedFile& file);

}  // namespace dmpc::apps::gltf
