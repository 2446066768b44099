#include "apps/foreign/mesh/features.h"

#include <cstdint>
#include <set>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/material.h"
#include "apps/foreign/mesh/textures.h"

namespace dmpc::apps {
namespace {

template <class List, class Predicate>
std::uint64_t count(const List& list, const Predicate& predicate) {
  std::uint64_t found = 0;
  for (const auto& entry : list) {
    found += predicate(*entry) ? 1 : 0;
  }
  return found;
}

std::uint64_t points_and_lines(const aiMesh& mesh) {
  std::uint64_t found = 0;
  for (std::size_t i = 0; i < mesh.mNumFaces; ++i) {
    found += mesh.mFaces[i].mNumIndices < 3 ? 1 : 0;
  }
  return found;
}

void note_meshes(const std::set<const aiMesh*>& meshes, std::vector<std::string>& notes) {
  std::uint64_t thin = 0;
  for (const aiMesh* mesh : meshes) {
    thin += points_and_lines(*mesh);
  }
  note_count(notes, "points and lines left out", thin);
  note_count(notes, "meshes with several sets of texture coordinates, of which colours use one",
             count(meshes, [](const aiMesh& mesh) { return mesh.GetNumUVChannels() > 1; }));
  note_count(notes, "meshes with a skin, shown in the pose in which their joints stand",
             count(meshes, [](const aiMesh& mesh) { return mesh.HasBones(); }));
  note_count(notes, "meshes with morph targets, shown without them",
             count(meshes, [](const aiMesh& mesh) { return mesh.mNumAnimMeshes > 0; }));
}

void note_materials(const std::set<const aiMaterial*>& materials, std::vector<std::string>& notes) {
  std::set<std::string> textures;
  for (const aiMaterial* material : materials) {
    list_textures(*material, textures);
  }
  note_count(notes, "textures not used, since they are not of a surface's colour", textures.size());
  note_count(notes, "materials that shine by themselves, and light other things by paths, not by --transport=whitted",
             count(materials, is_emissive));
  note_count(notes, "materials whose own light is a texture's, shown without it", count(materials, has_emissive_texture));
  note_count(notes, "materials that colour what shines through them, shown without that",
             count(materials, colors_what_shines_through));
  note_count(notes, "materials cut away altogether by their alpha, whose faces are left out", count(materials, is_cut_away));
  note_count(notes, "materials with a clear coat, shown without it", count(materials, has_clear_coat));
  note_count(notes, "materials with factors outside 0 to 1, brought into it", count(materials, has_factor_beyond));
}

}  // namespace

void note_features(const aiScene& scene, const std::vector<Placement>& placements, std::vector<std::string>& notes) {
  std::set<const aiMesh*> meshes;
  std::set<const aiMaterial*> materials;
  for (const Placement& placement : placements) {
    const aiMesh* mesh = scene.mMeshes[placement.mesh];
    meshes.insert(mesh);
    if (mesh->mMaterialIndex < scene.mNumMaterials) {
      materials.insert(scene.mMaterials[mesh->mMaterialIndex]);
    }
  }
  note_materials(materials, notes);
  note_meshes(meshes, notes);
  note_count(notes, "animations not played", scene.mNumAnimations);
}

}  // namespace dmpc::apps
