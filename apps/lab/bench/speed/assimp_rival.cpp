#include "apps/lab/bench/speed/assimp_rival.h"

#include <assimp/cimport.h>
#include <assimp/scene.h>

#include <memory>

#include "apps/edge/system/module.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Its library, opened when it is first wanted, as it takes long to load: all else that this program does goes without.
class Assimp {
 public:
  Assimp() : library_(open_library(DMPC_ASSIMP_LIBRARY)) {
    if (library_ == nullptr) {
      throw core::InputError("--parts=load: " DMPC_ASSIMP_LIBRARY " cannot be opened: install Assimp");
    }
  }
  template <class Function>
  Function* find(const char* name) const {
    void* const found = exported_by(library_, name);
    core::expect(found != nullptr, "Assimp has its functions");
    return reinterpret_cast<Function*>(found);
  }

 private:
  void* library_;
};

}  // namespace

std::uint64_t read_by_assimp(const std::filesystem::path& path) {
  static const Assimp assimp;
  static const auto read = assimp.find<decltype(aiImportFile)>("aiImportFile");
  static const auto forget = assimp.find<decltype(aiReleaseImport)>("aiReleaseImport");
  static const auto complaint = assimp.find<decltype(aiGetErrorString)>("aiGetErrorString");
  const std::unique_ptr<const aiScene, decltype(forget)> scene(read(path.c_str(), 0), forget);
  if (scene == nullptr) {
    throw core::InputError(path.string() + ": " + complaint());
  }
  std::uint64_t faces = 0;
  for (unsigned mesh = 0; mesh < scene->mNumMeshes; ++mesh) {
    faces += scene->mMeshes[mesh]->mNumFaces;
  }
  return faces;
}

}  // namespace dmpc::apps
