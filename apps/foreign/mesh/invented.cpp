#include "apps/foreign/mesh/invented.h"

#include <assimp/GltfMaterial.h>

#include <algorithm>
#include <optional>
#include <span>

namespace dmpc::apps {
namespace {

std::optional<ai_real> number(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
  ai_real value = 0;
  return material.Get(key, type, index, value) == aiReturn_SUCCESS ? std::optional(value) : std::nullopt;
}

void keep_words_of_fbx(aiMaterial& material) {
  int shading = 0;
  if (number(material, AI_MATKEY_SHININESS) && !number(material, AI_MATKEY_METALLIC_FACTOR)) {
    material.RemoveProperty(AI_MATKEY_ROUGHNESS_FACTOR);
  }
  if (material.Get(AI_MATKEY_SHADING_MODEL, shading) != aiReturn_SUCCESS) {
    material.RemoveProperty(AI_MATKEY_COLOR_SPECULAR);
  }
}

void keep_words_of_x3d(aiMaterial& material) {
  constexpr ai_real exponent_of_1 = 128;
  if (const auto shininess = number(material, AI_MATKEY_SHININESS)) {
    const ai_real exponent = *shininess * exponent_of_1;
    material.RemoveProperty(AI_MATKEY_SHININESS);
    material.AddProperty(&exponent, 1, AI_MATKEY_SHININESS);
  }
}

/// Assimp gives AMF without colours black ones that nobody sees through.
void drop_empty_colors(aiMesh& mesh) {
  const auto is_nothing = [](const aiColor4D& color) { return color == aiColor4D(0, 0, 0, 0); };
  if (mesh.mColors[0] != nullptr && std::all_of(mesh.mColors[0], mesh.mColors[0] + mesh.mNumVertices, is_nothing)) {
    delete[] mesh.mColors[0];
    mesh.mColors[0] = nullptr;
  }
}

}  // namespace

void take_back_invented(aiScene& scene, const std::string& ending) {
  for (aiMaterial* const material : std::span(scene.mMaterials, scene.mNumMaterials)) {
    if (ending == "fbx") {
      keep_words_of_fbx(*material);
    } else if (ending == "x3d") {
      keep_words_of_x3d(*material);
    }
  }
  if (ending == "amf") {
    for (aiMesh* const mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
      drop_empty_colors(*mesh);
    }
  }
}

}  // namespace dmpc::apps
