// The materials of a glTF document as Assimp's.
#pragma once

#include <assimp/scene.h>

#include <string>
#include <vector>

#include "apps/foreign/gltf/images.h"
#include "apps/foreign/mesh/imported_file.h"

namespace dmpc::apps::gltf {

/// Gives the scene its materials, with the keys that Assimp's own reader uses (apps/foreign/mesh/material.h looks for them), and,
/// last, that of primitives without one. Returns what else is known of their textures. `notes` gets a sentence for textures that
/// name no picture. Throws core::InputError, by its place in the document.
std::vector<MaterialTextures> add_materials(const Document& document, Images& images, aiScene& scene,
                                            std::vector<std::string>& notes);

}  // namespace dmpc::apps::gltf
