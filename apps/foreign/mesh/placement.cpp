#include "apps/foreign/mesh/placement.h"

#include <algorithm>
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
  if (!std::isfinite(world.determinant()) || !is_finite(world.shift)) {
    throw core::InputError("the transform of the node '" + std::string(node.mName.C_Str()) + "' is not finite; correct it");
  }
}

/// Onto a line or a point, where no face has an area: so exporters hide what a node places.
bool leaves_no_area(const Transform& world) {
  const Transform areas = world.of_normals();
  return std::all_of(areas.rows.begin(), areas.rows.end(), [](const core::Vec3d& row) { return row == core::Vec3d{}; });
}

/// What is posed stands in the root's own coordinates, `whole`.
void place_meshes(const aiScene& scene, const aiNode& node, const Transform& world, const Transform& whole,
                  std::vector<Placement>& placements) {
  if (node.mNumMeshes > 0) {
    check(node, world);
  }
  const bool is_there = !leaves_no_area(world);
  for (std::size_t i = 0; i < node.mNumMeshes; ++i) {
    if (node.mMeshes[i] >= scene.mNumMeshes) {
      throw core::InputError("the node '" + std::string(node.mName.C_Str()) + "' places mesh " + std::to_string(node.mMeshes[i]) +
                             ", and there are but " + std::to_string(scene.mNumMeshes));
    }
    const bool is_posed = scene.mMeshes[node.mMeshes[i]]->HasBones();
    if (is_there || is_posed) {
      placements.push_back({node.mMeshes[i], is_posed ? whole : world});
    }
  }
}

}  // namespace

std::vector<Placement> find_placements(const aiScene& scene, const NodeInstances& instances, double scale) {
  std::vector<Placement> placements;
  std::vector<Visit> waiting;
  if (scene.mRootNode != nullptr) {
    waiting.push_back({scene.mRootNode, scaling(scale)});
  }
  while (!waiting.empty()) {
    const auto [node, parent] = waiting.back();
    waiting.pop_back();
    const Transform world = parent * node->mTransformation;
    if (const auto places = instances.find(node); places != instances.end()) {
      for (const aiMatrix4x4& place : places->second) {
        place_meshes(scene, *node, parent * place, scaling(scale), placements);
      }
      continue;
    }
    place_meshes(scene, *node, world, scaling(scale), placements);
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
