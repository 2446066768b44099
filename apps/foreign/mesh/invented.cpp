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

/// The name that an importer gives to what it makes up, where the file has no such word.
std::string_view invented_name(const std::string& ending) {
  return ending == "fbx" ? AI_DEFAULT_MATERIAL_NAME : ending == "3ds" ? "%%%DEFAULT" : "";
}

/// A material that stands for none.
bool is_invented(const aiMaterial& material, const std::string& ending, std::string_view file) {
  aiString name;
  material.Get(AI_MATKEY_NAME, name);
  const std::string_view invented = invented_name(ending);
  return ending == "x" ? is_invented_for_x(material)
                       : !invented.empty() && name.C_Str() == invented && file.find(invented) == std::string_view::npos;
}

/// Assimp gives AMF without colours black ones that nobody sees through.
void drop_empty_colors(aiMesh& mesh) {
  const auto is_nothing = [](const aiColor4D& color) { return color == aiColor4D(0, 0, 0, 0); };
  if (mesh.mColors[0] != nullptr && std::all_of(mesh.mColors[0], mesh.mColors[0] + mesh.mNumVertices, is_nothing)) {
    delete[] mesh.mColors[0];
    mesh.mColors[0] = nullptr;
  }
}

/// 3ds Max's look along -z.
void turn_cameras(aiScene& scene) {
  for (aiCamera* const camera : std::span(scene.mCameras, scene.mNumCameras)) {
    camera->mLookAt = -camera->mLookAt;
  }
}

}  // namespace

bool is_invented_for_x(const aiMaterial& material) {
  aiString name;
  return material.Get(AI_MATKEY_NAME, name) != aiReturn_SUCCESS;
}

void take_back_invented(aiScene& scene, const std::string& ending, std::string_view file) {
  for (aiMaterial* const material : std::span(scene.mMaterials, scene.mNumMaterials)) {
    if (is_invented(*material, ending, file)) {
      material->RemoveProperty(AI_MATKEY_COLOR_DIFFUSE);
    }
    if (ending == "fbx") {
      keep_words_of_fbx(*material);
    } else if (ending == "dae") {
      material->RemoveProperty(AI_MATKEY_UVWSRC(aiTextureType_DIFFUSE, 0));
    }
  }
  if (ending == "amf") {
    for (aiMesh* const mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
      drop_empty_colors(*mesh);
    }
  } else if (ending == "ase") {
    turn_cameras(scene);
  }
}

}  // namespace dmpc::apps
