// Reads glTF 2.0.
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"
#include "apps/formats/mesh_options.h"

namespace dmpc::apps::gltf {

/// It is strict: what refers to something that does not exist, reaches beyond its bytes, or is required and not shown, is a
/// core::InputError that names the place in the document, "meshes[0].primitives[1]: ...". At an animation's moment, if one is
/// asked for, nodes stand as pose_at() says (apps/foreign/gltf/animation.h), else as they say themselves.
PlacedFile read_gltf(const std::string& path, const MeshOptions& options, SceneFiles& files);

}  // namespace dmpc::apps::gltf
