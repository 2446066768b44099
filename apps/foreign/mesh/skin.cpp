#include "apps/foreign/mesh/skin.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>

#include "apps/edge/line/number_text.h"
#include "apps/foreign/mesh/placed_mesh.h"
#include "apps/foreign/mesh/transform.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

/// Where the nodes stand: by name, and by the mesh that they place; the first of several counts.
struct Stands {
  std::map<std::string, Transform> of_name;
  std::map<std::size_t, Transform> of_mesh;
};

Stands stands_of(const aiScene& scene) {
  Stands stands;
  std::vector<std::pair<const aiNode*, Transform>> waiting;
  if (scene.mRootNode != nullptr) {
    waiting.emplace_back(scene.mRootNode, Transform{});
  }
  while (!waiting.empty()) {
    const auto [node, parent] = waiting.back();
    waiting.pop_back();
    const Transform world = parent * node->mTransformation;
    stands.of_name.emplace(node->mName.C_Str(), world);
    for (const unsigned mesh : std::span(node->mMeshes, node->mNumMeshes)) {
      stands.of_mesh.emplace(mesh, world);
    }
    for (std::size_t i = node->mNumChildren; i-- > 0;) {
      waiting.emplace_back(node->mChildren[i], world);
    }
  }
  return stands;
}

void add(Transform& sum, const Transform& term, double weight) {
  for (std::size_t row = 0; row < 3; ++row) {
    sum.rows[row] = sum.rows[row] + term.rows[row] * weight;
  }
  sum.shift = sum.shift + term.shift * weight;
}

constexpr Transform nothing{{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}, {0, 0, 0}};

/// The transform of each vertex.
std::vector<Transform> transforms_of(const aiMesh& mesh, std::size_t index, const Stands& stands) {
  std::vector<Transform> transforms(mesh.mNumVertices, nothing);
  std::vector<double> sums(mesh.mNumVertices);
  for (const aiBone* const bone : std::span(mesh.mBones, mesh.mNumBones)) {
    const Transform held = stands.of_name.at(bone->mName.C_Str()) * bone->mOffsetMatrix;
    for (const aiVertexWeight& weight : std::span(bone->mWeights, bone->mNumWeights)) {
      if (weight.mVertexId >= mesh.mNumVertices || !(weight.mWeight >= 0) || !std::isfinite(weight.mWeight)) {
        throw core::InputError(name_of(mesh, index) + ": the joint '" + bone->mName.C_Str() + "' holds vertex " +
                               std::to_string(weight.mVertexId) +
                               ", which does not exist, or with a weight that is below 0 or not finite; correct the file");
      }
      add(transforms[weight.mVertexId], held, double{weight.mWeight});
      sums[weight.mVertexId] += double{weight.mWeight};
    }
  }
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    Transform share = nothing;
    add(share, transforms[i], sums[i] > 0 ? 1 / sums[i] : 0);
    transforms[i] = sums[i] > 0 ? share : stands.of_mesh.at(index);
  }
  return transforms;
}

aiVector3D to_ai(const Vec3d& v) { return {static_cast<ai_real>(v.x), static_cast<ai_real>(v.y), static_cast<ai_real>(v.z)}; }

/// A face that is mirrored looks to its old side again when its corners are turned round.
void turn_mirrored(aiMesh& mesh, FaceList& triangles, const std::vector<Transform>& transforms) {
  for (std::size_t first = 0; first < triangles.corners.size(); first += 3) {
    const auto corner = triangles.corners.begin() + static_cast<std::ptrdiff_t>(first);
    if (*corner < transforms.size() && transforms[*corner].determinant() < 0) {
      std::reverse(corner, corner + 3);
    }
  }
  for (aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
    if (face.mNumIndices > 0 && face.mIndices[0] < transforms.size() && transforms[face.mIndices[0]].determinant() < 0) {
      std::reverse(face.mIndices, face.mIndices + face.mNumIndices);
    }
  }
}

void pose(aiMesh& mesh, std::size_t index, FaceList& triangles, const Stands& stands) {
  const std::vector<Transform> transforms = transforms_of(mesh, index, stands);
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    mesh.mVertices[i] = to_ai(transforms[i].point(to_vec(mesh.mVertices[i])));
    if (mesh.HasNormals()) {
      const Vec3d normal = transforms[i].of_normals().direction(to_vec(mesh.mNormals[i]));
      const double size = length(normal);
      mesh.mNormals[i] = to_ai(size > 0 ? normal * (1 / size) : normal);
    }
  }
  turn_mirrored(mesh, triangles, transforms);
}

void forget_bones(aiMesh& mesh) {
  for (aiBone* const bone : std::span(mesh.mBones, mesh.mNumBones)) {
    delete bone;
  }
  delete[] mesh.mBones;
  mesh.mBones = nullptr;
  mesh.mNumBones = 0;
}

}  // namespace

void pose_skins(ImportedFile& file, std::vector<std::string>& notes) {
  aiScene& scene = *file.scene;
  const std::span<aiMesh*> meshes(scene.mMeshes, scene.mNumMeshes);
  if (std::none_of(meshes.begin(), meshes.end(), [](const aiMesh* mesh) { return mesh->HasBones(); })) {
    return;
  }
  const Stands stands = stands_of(scene);
  std::uint64_t loose = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    aiMesh& mesh = *meshes[i];
    const std::span<aiBone*> bones(mesh.mBones, mesh.mNumBones);
    const bool is_known =
        std::all_of(bones.begin(), bones.end(), [&](const aiBone* bone) { return stands.of_name.contains(bone->mName.C_Str()); });
    if (!mesh.HasBones() || !stands.of_mesh.contains(i)) {
      continue;
    }
    if (is_known) {
      pose(mesh, i, file.triangles_of(i), stands);
    } else {
      forget_bones(mesh);
      ++loose;
    }
  }
  if (loose > 0) {
    notes.push_back("meshes with a skin whose joints are nowhere, shown where their node stands: " + grouped(loose));
  }
}

}  // namespace dmpc::apps
