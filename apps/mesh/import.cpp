#include "apps/mesh/import.h"

#include <assimp/DefaultIOSystem.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <system_error>

#include "apps/progress.h"
#include "core/expect.h"

namespace dmpc::apps {
namespace {

/// The files of the computer, with lists of those opened and of those asked for in vain.
class Files final : public Assimp::DefaultIOSystem {
 public:
  explicit Files(ImportedFile& file) : opened_(file.opened), missing_(file.missing) {}

  Assimp::IOStream* Open(const char* path, const char* mode) override {
    Assimp::IOStream* const stream = DefaultIOSystem::Open(path, mode);
    if (stream != nullptr) {
      opened_.add(path);
    } else if (std::find(missing_.begin(), missing_.end(), path) == missing_.end()) {
      missing_.emplace_back(path);
    }
    return stream;
  }

 private:
  OpenedFiles& opened_;
  std::vector<std::string>& missing_;
};

/// Assimp's shares of the work as bytes of the file.
class LoadProgress final : public Assimp::ProgressHandler {
 public:
  LoadProgress(const std::string& path, bool shown) : progress_(std::cerr, shown, "Reading " + path + ":", "bytes") {
    std::error_code unknown;
    const auto size = std::filesystem::file_size(path, unknown);
    file_bytes_ = unknown ? 1 : std::max<std::uint64_t>(size, 1);
  }

  bool Update(float share) override {
    const double done = std::clamp(double{share}, 0.0, 1.0) * static_cast<double>(file_bytes_);
    progress_.update(static_cast<std::uint64_t>(done), file_bytes_);
    return true;
  }
  void UpdateFileRead(int step, int step_count) override {
    Update(step_count > 0 ? static_cast<float>(step) / static_cast<float>(step_count) : 1.0F);
  }

 private:
  Progress progress_;
  std::uint64_t file_bytes_ = 1;
};

/// What Assimp has caught on its way out, if that was the end of memory.
void rethrow_end_of_memory(const std::exception_ptr& caught) {
  try {
    if (caught) {
      std::rethrow_exception(caught);
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {  // told by its text
  }
}

}  // namespace

const std::vector<std::string>& mesh_extensions() {
  static const std::vector<std::string> extensions = {"obj", "ply", "stl", "gltf", "glb",  "3ds", "3mf", "ac", "amf",
                                                      "ase", "dae", "fbx", "lwo",  "ms3d", "off", "x",   "x3d"};
  return extensions;
}

ImportedFile import_file(const std::string& path, bool shows_progress) {
  ImportedFile file;
  Assimp::Importer importer;
  importer.SetIOHandler(new Files(file));  // is the importer's from now on, and so is the next
  importer.SetProgressHandler(new LoadProgress(path, shows_progress));
  if (importer.ReadFile(path, 0) == nullptr) {
    rethrow_end_of_memory(importer.GetException());
    throw core::InputError(importer.GetErrorString());
  }
  file.scene.reset(importer.GetOrphanedScene());
  return file;
}

}  // namespace dmpc::apps
