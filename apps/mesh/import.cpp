#include "apps/mesh/import.h"

#include <assimp/DefaultIOSystem.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <new>
#include <optional>
#include <system_error>

#include "apps/gltf/reader.h"
#include "apps/mesh/named_file.h"
#include "apps/mesh/obj_check.h"
#include "apps/mesh/ply_check.h"
#include "apps/mesh/stl_check.h"
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

bool ends_in(const std::string& path, const std::vector<std::string>& endings) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

std::vector<std::byte> bytes_of_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::vector<std::byte> bytes;
  for (std::size_t size = 0; stream; bytes.resize(size + static_cast<std::size_t>(stream.gcount()))) {
    size = bytes.size();
    bytes.resize(size + std::max<std::size_t>(size, 65536));
    stream.read(reinterpret_cast<char*>(bytes.data() + size), static_cast<std::streamsize>(bytes.size() - size));
  }
  return bytes;
}

/// What Assimp takes for a scene, or for ever to read, although something of it is missing.
void check_is_whole(const std::string& path) {
  const auto check = ends_in(path, {".ply"})   ? check_ply
                     : ends_in(path, {".stl"}) ? check_stl
                     : ends_in(path, {".obj"}) ? check_obj
                                               : nullptr;
  if (check != nullptr) {
    const std::vector<std::byte> bytes = bytes_of_file(path);
    check({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
}

/// Nothing for version 1, which is left to Assimp.
std::optional<ImportedFile> import_gltf(const std::string& path) {
  const std::vector<std::byte> bytes = bytes_of_file(path);
  const gltf::Document document = gltf::parse_document(bytes);
  if (document.version == 1) {
    return std::nullopt;
  }
  OpenedFiles opened;
  opened.add(path);
  const auto open = [&](const std::string& name) {
    const auto files = files_meant(std::filesystem::path(path).parent_path(), name);
    if (files.empty()) {
      throw core::InputError(name + " is missing or cannot be opened");
    }
    opened.add(files.front());
    return bytes_of_file(files.front());
  };
  ImportedFile file = gltf::read_gltf(document, open);
  file.opened.add(opened);
  return file;
}

/// Whether Assimp has put a figure of its own in place of the meshes that the file does not have: one for its tree of nodes.
bool is_figure_of_nodes(const aiScene& scene) {
  const auto is_named_so = [](const aiMaterial* material) {
    return std::string(material->GetName().C_Str()) == "SkeletonMaterial";
  };
  return (scene.mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0 &&
         std::any_of(scene.mMaterials, scene.mMaterials + scene.mNumMaterials, is_named_so);
}

void check_has_mesh(const aiScene& scene) {
  if (scene.mNumMeshes == 0 || is_figure_of_nodes(scene)) {
    throw core::InputError(
        "there is no mesh in it, and so no triangle that has an area; expected a mesh of triangles or polygons");
  }
}

}  // namespace

const std::vector<std::string>& mesh_extensions() {
  static const std::vector<std::string> extensions = {"obj", "ply", "stl", "gltf", "glb",  "3ds", "3mf", "ac", "amf",
                                                      "ase", "dae", "fbx", "lwo",  "ms3d", "off", "x",   "x3d"};
  return extensions;
}

ImportedFile import_file(const std::string& path, bool shows_progress) {
  if (ends_in(path, {".gltf", ".glb"})) {
    if (auto file = import_gltf(path)) {
      return *std::move(file);
    }
  }
  check_is_whole(path);
  ImportedFile file;
  Assimp::Importer importer;
  importer.SetIOHandler(new Files(file));  // is the importer's from now on, and so is the next
  importer.SetProgressHandler(new LoadProgress(path, shows_progress));
  if (importer.ReadFile(path, 0) == nullptr) {
    rethrow_end_of_memory(importer.GetException());
    throw core::InputError(importer.GetErrorString());
  }
  check_has_mesh(*importer.GetScene());
  file.scene.reset(importer.GetOrphanedScene());
  return file;
}

}  // namespace dmpc::apps
