// The skins of a glTF document as bones of Assimp's meshes.
#pragma once

#include <assimp/scene.h>

#include <map>
#include <string>
#include <vector>

#include "apps/foreign/gltf/accessors.h"
#include "apps/foreign/gltf/meshes.h"

namespace dmpc::apps::gltf {

/// What stands at a node: a mesh of the document, and the skin that holds it, if one does.
struct MeshUse {
  aiNode* node = nullptr;
  std::size_t mesh = 0;
  std::optional<Part> skin;  ///< the member that names it
};

/// Gives nodes their meshes: plain ones as they are, those with a skin one of their own with its bones, which bear the names of
/// the joints' nodes (`names`, by their places in the document), for apps/foreign/mesh/skin.h. Throws core::InputError, by its
/// place in the document, for a joint that does not exist or stands outside the scene, for fewer inverse bind matrices than
/// joints and for joints of vertices that the skin has not. Notes how many meshes have a skin and nothing that it holds them
/// by.
void give_meshes(const Document& document, Accessors& accessors, const Meshes& meshes, const std::vector<MeshUse>& uses,
                 const std::map<std::size_t, std::string>& names, ImportedFile& file);

}  // namespace dmpc::apps::gltf
