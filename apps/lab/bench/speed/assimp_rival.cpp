#include "apps/lab/bench/speed/assimp_rival.h"

#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "core/base/expect.h"

namespace dmpc::apps {

std::uint64_t read_by_assimp(const std::filesystem::path& path) {
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile(path.string(), 0);
  if (scene == nullptr) {
    throw core::InputError(path.string() + ": " + importer.GetErrorString());
  }
  std::uint64_t faces = 0;
  for (unsigned mesh = 0; mesh < scene->mNumMeshes; ++mesh) {
    faces += scene->mMeshes[mesh]->mNumFaces;
  }
  return faces;
}

}  // namespace dmpc::apps
