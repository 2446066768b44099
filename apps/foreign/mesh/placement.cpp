#include "apps/foreign/mesh/placement.h"

#include <cmath>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// A node whose meshes and children are still to be looked at.
struct Visit {
  const aiNode* node;
  Transform parent;
};

void check(const aiNode& node, const Transform& world) {
  const double determinant = world.determinant();
  if (!std::isfinite(determinant) || !is_finite(world.shift)) {
    throw core::InputError("the transform of the node '" + std::string(node.mName.C_Str()) + "' is not finite; correct it");
  }
  if (determinant == 0) {
    throw core::InputError("the transform of the node '" + std::string(node.mName.C_Str()) +
                           "' flattens what it places (its determinant is 0); correct it");
  }
}

void place_meshes(const aiScene& scene, const aiNode& node, const Transform& world, std::vector<Placement>& placements) {
  if (node.mNumMeshes > 0) {
    check(node, world);
  }
  for (std::size_t i = 0; i < node.mNumMeshes; ++i) {
    if (node.mMeshes[i] >= scene.mNumMeshes) {
      throw core::InputError("the node '" + std::string(node.mName.C_Str()) + "' places mesh " + std::to_string(node.mMeshes[i]) +
                             ", and there are but " + std::to_string(scene.mNumMeshes));
    }
    placements.push_back({node.mMeshes[i], world});
  }
}

}  // namespace

std::vector<Placement> find_placements(const aiScene& scene, double scale) {
  std::vector<Placement> placements;
  std::vector<Visit> waiting;
  if (scene.mRootNode != nullptr) {
    waiting.push_back({scene.mRootNode, scaling(scale)});
  }
  while (!waiting.empty()) {
    const auto [node, parent] = waiting.back();
    waiting.pop_back();
    const Transform world = parent * node->mTransformation;
    place_meshes(scene, *node, world, placements);
    for (std::size_t i = node->mNumChildren; i-- > 0;) {
      waiting.push_back({node->mChildren[i], world});
    }
  }
  return placements;
}

Transform world_of(const aiScene& scene, const aiString& name, double scale) {
  std::vector<const aiNode*> path;
  for (const aiNode* node = scene.mRootNode->FindNode(name); node != nullptr; node = node->mParent) {
    path.push_back(node);
  }
  Transform world = scaling(scale);
  for (; !path.empty(); path.pop_back()) {
    world = world * path.back()->mTransformation;
  }
  return world;
}

}  // namespace dmpc::apps
