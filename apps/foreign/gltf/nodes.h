// The tree of nodes of a glTF document as Assimp's, with cameras and lights.
#pragma once

#include <assimp/scene.h>

#include "apps/foreign/gltf/accessors.h"
#include "apps/foreign/gltf/animation.h"
#include "apps/foreign/gltf/meshes.h"

namespace dmpc::apps::gltf {

/// Gives the file's scene the nodes of the document's scene, the first if it names none; what hidden ones (KHR_node_visibility)
/// would show is left out, and instances (EXT_mesh_gpu_instancing) are one node in many places. What `pose` says of a node takes
/// the place of what it says itself. Throws core::InputError, by its place in the document, for nodes that are no tree, and for
/// transforms that are none.
void add_nodes(const Document& document, Accessors& accessors, const Meshes& meshes, const Pose& pose, ImportedFile& file);

}  // namespace dmpc::apps::gltf
