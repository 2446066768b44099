// Where the meshes of a file stand: its tree of nodes as a flat list.
#pragma once

#include <assimp/scene.h>

#include <cstddef>
#include <vector>

#include "apps/foreign/mesh/imported_file.h"
#include "apps/foreign/mesh/transform.h"

namespace dmpc::apps {

/// A mesh in one place.
struct Placement {
  std::size_t mesh = 0;  ///< index into aiScene::mMeshes
  Transform world;
};

/// All nodes from the root down in the file's order, each mesh of each; coordinates are multiplied by `scale`. What a transform
/// presses onto a line or a point, as a scale of 0 does, has no area and is left out; what it presses flat stays. Meshes with
/// bones were posed (apps/foreign/mesh/skin.h), and no node moves them any more. Throws core::InputError, with the node's name,
/// for a transform that is not finite and for a mesh that does not exist.
std::vector<Placement> find_placements(const aiScene& scene, const NodeInstances& instances, double scale);

/// From the coordinates of the node of this name, which a camera or light shares, to the world's; the root's if there is none.
Transform world_of(const aiScene& scene, const aiString& name, double scale);

}  // namespace dmpc::apps
