#include "apps/foreign/gltf/reader.h"

#include <assimp/commonMetaData.h>

#include "apps/edge/line/number_text.h"
#include "apps/foreign/gltf/extensions.h"
#include "apps/foreign/gltf/materials.h"
#include "apps/foreign/gltf/nodes.h"

namespace dmpc::apps::gltf {
namespace {

/// Those that are not played are counted by others, and never looked into.
void add_animations(const Document& document, bool is_one_played, aiScene& scene) {
  const std::size_t count = document.root().list("animations").size() - (is_one_played ? 1 : 0);
  scene.mAnimations = count > 0 ? new aiAnimation*[count] : nullptr;
  for (; scene.mNumAnimations < count; ++scene.mNumAnimations) {
    scene.mAnimations[scene.mNumAnimations] = new aiAnimation;
  }
}

}  // namespace

ImportedFile read_gltf(const Document& document, const OpenNamed& open, const std::optional<AnimationMoment>& animation) {
  check_required(document);
  ImportedFile file;
  file.scene = std::make_unique<aiScene>();
  file.scene->mMetaData = aiMetadata::Alloc(1);
  file.scene->mMetaData->Set(0, AI_METADATA_SOURCE_FORMAT, aiString(gltf_source_format));
  Buffers buffers(document, open);
  Accessors accessors(document, buffers);
  Images images(document, buffers);
  file.textures = add_materials(document, images, *file.scene, file.notes);
  const Meshes meshes = add_meshes(document, buffers, file);
  const Pose pose = animation ? pose_at(*animation, document, accessors, file.notes) : Pose{};
  add_nodes(document, accessors, meshes, pose, file);
  images.give_to(*file.scene);
  add_animations(document, animation.has_value(), *file.scene);
  note_extensions(document, file.notes);
  if (meshes.corners_left_over > 0) {
    file.notes.push_back("corners left over at the ends of lists of triangles, left out: " + grouped(meshes.corners_left_over));
  }
  return file;
}

}  // namespace dmpc::apps::gltf
