// The nodes of a glTF document's scene with their transforms, cameras and lights.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/gltf/accessors.h"
#include "apps/foreign/gltf/animation.h"
#include "apps/foreign/gltf/meshes.h"
#include "apps/foreign/mesh/placed_file.h"
#include "apps/formats/resolution.h"

namespace dmpc::apps::gltf {

/// A mesh of the document at a node.
struct MeshUse {
  std::string node;  ///< its name
  std::size_t mesh = 0;
  std::vector<Transform> places;            ///< to world space: one, or more for GPU instances
  std::optional<Part> skin = std::nullopt;  ///< the member that names the skin
};

struct Nodes {
  std::map<std::size_t, Transform> worlds;  ///< the scene's nodes, by their indices in the document
  std::vector<MeshUse> uses;                ///< in the tree's order
  std::vector<FileView> views;              ///< in the document's order of cameras; lights likewise
  std::vector<FileLight> lights;
};

/// Reads the nodes of the document's scene, the first if it names none, without the contents of hidden nodes
/// (KHR_node_visibility); instances (EXT_mesh_gpu_instancing) are one use with many transforms. `pose` overrides nodes' own
/// transforms. A camera's own picture has 512 pixels on its shorter side; its angle spans the vertical of a picture of `size`,
/// its own if none is given, from edge to edge (core::View's goes between the middles of pixels). Throws core::InputError, with
/// the place in the document, for nodes that are no tree and for invalid transforms.
Nodes read_nodes(const Document& document, Accessors& accessors, const Meshes& meshes, const Pose& pose,
                 const std::optional<Resolution>& size, SceneTotals& totals);

}  // namespace dmpc::apps::gltf
