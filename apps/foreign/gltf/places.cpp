#include "apps/foreign/gltf/skins.h"

#include <assimp/SceneCombiner.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "apps/foreign/mesh/count_note.h"

namespace dmpc::apps::gltf {
namespace {

using Weights = std::vector<aiVertexWeight>;

struct Joint {
  std::string name;
  aiMatrix4x4 bind;
};

/// Columns follow each other.
aiMatrix4x4 matrix_of(const Values& values, std::size_t i) {
  aiMatrix4x4 matrix;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      matrix[row][column] = values[i][4 * column + row];
    }
  }
  return matrix;
}

std::vector<Joint> joints_of(const Part& skin, std::size_t node_count, Accessors& accessors,
                             const std::map<std::size_t, std::string>& names) {
  std::vector<Joint> joints;
  for (const Part& part : skin.list("joints")) {
    const std::size_t node = part.as_index(node_count, "nodes");
    const auto name = names.find(node);
    if (name == names.end()) {
      part.fail("is of nodes[" + std::to_string(node) + "], which does not stand in the scene that is shown");
    }
    joints.push_back({name->second, {}});
  }
  if (const auto where = skin.find("inverseBindMatrices")) {
    const Values binds = accessors.values(*where, 16);
    if (binds.count() < joints.size()) {
      where->fail("has " + std::to_string(binds.count()) + " matrices, expected one for each of " +
                  std::to_string(joints.size()) + " joints");
    }
    for (std::size_t i = 0; i < joints.size(); ++i) {
      joints[i].bind = matrix_of(binds, i);
    }
  }
  return joints;
}

/// For each joint which vertices it holds. One with a weight of 0 holds nothing, and may be any.
std::vector<Weights> weights_of(const Influences& influences, std::size_t joint_count, const Part& skin) {
  std::vector<Weights> weights(joint_count);
  for (std::size_t set = 0; set < influences.joints.size(); ++set) {
    const Values &joints = influences.joints[set], &shares = influences.weights[set];
    for (std::size_t i = 0; i < joints.numbers.size(); ++i) {
      const auto joint = double{joints.numbers[i]};
      const bool holds = shares.numbers[i] < 0 || shares.numbers[i] > 0 || !std::isfinite(shares.numbers[i]);
      if (holds && !(joint >= 0 && joint < static_cast<double>(joint_count) && joint == std::floor(joint))) {
        skin.fail("vertex " + std::to_string(i / 4) + " is held by joint " + std::to_string(static_cast<std::int64_t>(joint)) +
                  ", which does not exist: there are " + std::to_string(joint_count));
      }
      if (holds) {
        weights[static_cast<std::size_t>(joint)].emplace_back(static_cast<unsigned>(i / 4), shares.numbers[i]);
      }
    }
  }
  return weights;
}

void give_bones(aiMesh& mesh, const std::vector<Joint>& joints, const std::vector<Weights>& weights) {
  mesh.mBones = new aiBone*[joints.size() + 1];
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (weights[i].empty()) {
      continue;
    }
    auto* const bone = mesh.mBones[mesh.mNumBones++] = new aiBone;
    bone->mName = joints[i].name;
    bone->mOffsetMatrix = joints[i].bind;
    bone->mWeights = new aiVertexWeight[weights[i].size()];
    bone->mNumWeights = static_cast<unsigned>(weights[i].size());
    std::copy(weights[i].begin(), weights[i].end(), bone->mWeights);
  }
}

void append(aiMesh* mesh, aiScene& scene) {
  const std::unique_ptr<aiMesh*[]> before(scene.mMeshes);
  scene.mMeshes = new aiMesh*[scene.mNumMeshes + 1];
  std::copy(before.get(), before.get() + scene.mNumMeshes, scene.mMeshes);
  scene.mMeshes[scene.mNumMeshes++] = mesh;
}

/// Bones are the last user's of a mesh, others have copies with theirs.
class Skins {
 public:
  Skins(const Document& document, Accessors& accessors, const Meshes& meshes, const std::map<std::size_t, std::string>& names,
        ImportedFile& file)
      : skins_(document.root().list("skins")),
        node_count_(document.root().list("nodes").size()),
        accessors_(accessors),
        meshes_(meshes),
        names_(names),
        file_(file),
        scene_(*file.scene) {}

  bool holds(const MeshUse& use, unsigned mesh) const { return use.skin && !meshes_.influences[mesh].joints.empty(); }
  /// The scene's mesh for a use of `mesh`, of which `left` follow.
  unsigned skinned(const MeshUse& use, unsigned mesh, std::size_t left) {
    const Part& skin = skins_[use.skin->as_index(skins_.size(), "skins")];
    const std::vector<Joint> joints = joints_of(skin, node_count_, accessors_, names_);
    const std::vector<Weights> weights = weights_of(meshes_.influences[mesh], joints.size(), skin);
    unsigned own = mesh;
    if (left > 0) {
      aiMesh* copy = nullptr;
      Assimp::SceneCombiner::Copy(&copy, scene_.mMeshes[mesh]);
      own = scene_.mNumMeshes;
      append(copy, scene_);
      file_.triangles.push_back(FaceList(file_.triangles[mesh]));
    }
    give_bones(*scene_.mMeshes[own], joints, weights);
    return own;
  }

 private:
  std::vector<Part> skins_;
  std::size_t node_count_;
  Accessors& accessors_;
  const Meshes& meshes_;
  const std::map<std::size_t, std::string>& names_;
  ImportedFile& file_;
  aiScene& scene_;
};

}  // namespace

void give_meshes(const Document& document, Accessors& accessors, const Meshes& meshes, const std::vector<MeshUse>& uses,
                 const std::map<std::size_t, std::string>& names, ImportedFile& file) {
  Skins skins(document, accessors, meshes, names, file);
  constexpr std::size_t plain = std::size_t{1} << 32U;  // never the last
  std::map<unsigned, std::size_t> left;
  const auto for_each = [&](const auto& take) {
    for (const MeshUse& use : uses) {
      for (unsigned mesh = meshes.ranges[use.mesh].first; mesh < meshes.ranges[use.mesh].second; ++mesh) {
        take(use, mesh);
      }
    }
  };
  std::uint64_t loose = 0;
  for_each([&](const MeshUse& use, unsigned mesh) {
    left[mesh] += skins.holds(use, mesh) ? 1 : plain;
    loose += use.skin && !skins.holds(use, mesh) ? 1 : 0;
  });
  note_count(file.notes, "meshes with a skin and without joints and weights, shown where their node stands", loose);
  for (const MeshUse& use : uses) {
    use.node->mMeshes = new unsigned[meshes.ranges[use.mesh].second - meshes.ranges[use.mesh].first + 1];
  }
  for_each([&](const MeshUse& use, unsigned mesh) {
    use.node->mMeshes[use.node->mNumMeshes++] = skins.holds(use, mesh) ? skins.skinned(use, mesh, --left[mesh]) : mesh;
  });
}

}  // namespace dmpc::apps::gltf
