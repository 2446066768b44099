// What was read of a mesh file, by whatever reader.
#pragma once

#include <assimp/scene.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/mesh/texture_place.h"
#include "apps/foreign/mesh/textures.h"

namespace dmpc::apps {

/// What a scene's metadata call its format that our own reader of glTF made: lights.h knows its cameras by it.
inline constexpr const char* gltf_source_format = "glTF 2.0";

/// What is known of a material's textures beside what Assimp's types hold.
struct MaterialTextures {
  TexturePlace color_place;          ///< on that of its colour
  std::optional<TextureUse> facets;  ///< of metal and roughness: what glTF's metallicRoughnessTexture says
  TexturePlace facets_place;         ///< on that
};

/// Nodes that stand for many, and where they stand in their parent's coordinates, in place of their own transform: a node of
/// Assimp's takes more than a thousand bytes.
using NodeInstances = std::map<const aiNode*, std::vector<aiMatrix4x4>>;

struct ImportedFile {
  std::unique_ptr<aiScene> scene;
  NodeInstances instances;
  std::vector<FaceList> triangles;         ///< of each mesh, of vertices that exist, beside its own faces; or none at all
  std::vector<MaterialTextures> textures;  ///< of each material, or none at all
  std::vector<std::string> notes;          ///< what of the file is not shown as it is, a sentence each
  std::vector<std::string> missing;        ///< sentences: which files it refers to cannot be had, in order, each once

  FaceList& triangles_of(std::size_t mesh) {
    triangles.resize(scene->mNumMeshes);
    return triangles[mesh];
  }
};

}  // namespace dmpc::apps
