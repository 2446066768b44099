// Reads glTF 2.0.
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"
#include "apps/formats/mesh_options.h"

namespace dmpc::apps::gltf {

/// Strict: a reference to something that does not exist, data that exceed their bytes, or a required feature that is not
/// supported is a core::InputError with the place in the document, "meshes[0].primitives[1]: ...". If an animation is asked for,
/// nodes are posed by pose_at() (apps/foreign/gltf/animation.h) at its moment, otherwise by their own transforms.
PlacedFile read_gltf(const std::string& path, const MeshOptions& options, SceneFiles& files);

}  // namespace dmpc::apps::gltf
