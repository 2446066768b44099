#include "apps/lab/bench/speed/assimp_rival.h"

#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <dlfcn.h>

#include <memory>

#include "core/base/expect.h"
#include "core/base/usual_arithmetic.h"

namespace dmpc::apps {

namespace {

/// Its library, opened when it is first wanted, as it takes long to load: all else that this program does goes without.
class Assimp {
 public:
  Assimp() : library_(::dlopen(DMPC_ASSIMP_LIBRARY, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
    core::use_usual_arithmetic();
    if (library_ == nullptr) {
      throw core::InputError("--parts=load: " DMPC_ASSIMP_LIBRARY " cannot be opened: install Assimp");
    }
  }
  template <class Function>
  Function* find(const char* name) const {
    void* const found = ::dlsym(library_, name);
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
