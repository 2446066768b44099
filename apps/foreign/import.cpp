#include "apps/foreign/import.h"

#include <assimp/BaseImporter.h>
#include <assimp/version.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <cctype>
#include <cstddef>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "apps/edge/line/shown_text.h"
#include "apps/foreign/assimp_log.h"
#include "apps/foreign/gltf/counts.h"
#include "apps/foreign/gltf/extensions.h"
#include "apps/foreign/gltf/reader.h"
#include "apps/foreign/mesh/bare_meshes.h"
#include "apps/foreign/mesh/collada_bindings.h"
#include "apps/foreign/mesh/collada_losses.h"
#include "apps/foreign/mesh/collada_text.h"
#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/file_ending.h"
#include "apps/foreign/mesh/file_numbers.h"
#include "apps/foreign/mesh/hidden_nodes.h"
#include "apps/foreign/mesh/invented.h"
#include "apps/foreign/mesh/without_area.h"
#include "apps/foreign/mesh/xml_counts.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// Read only, from memory.
class Stream final : public Assimp::IOStream {
 public:
  explicit Stream(std::unique_ptr<FileBytes> file) : file_(std::move(file)) {}

  std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
    const auto left = file_->bytes().subspan(position_);
    const std::size_t whole = size == 0 ? 0 : std::min(count, left.size() / size);
    if (whole > 0) {
      std::memcpy(buffer, left.data(), whole * size);
    }
    position_ += whole * size;
    return whole;
  }
  std::size_t Write(const void* /*buffer*/, std::size_t /*size*/, std::size_t /*count*/) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t size = FileSize(), from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? position_ : size;
    const std::size_t target = from + offset;  // a step back comes as a large step, and wraps round
    if (target > size) {
      return aiReturn_FAILURE;
    }
    position_ = target;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return position_; }
  std::size_t FileSize() const override { return file_->bytes().size(); }
  void Flush() override {}

 private:
  std::unique_ptr<FileBytes> file_;
  std::size_t position_ = 0;
};

class TextBytes final : public FileBytes {
 public:
  explicit TextBytes(std::string text) : text_(std::move(text)) {}
  std::span<const std::byte> bytes() const override { return std::as_bytes(std::span(text_)); }

 private:
  std::string text_;
};

/// As a reader of Assimp's sees them, with a list of what was asked for in vain.
class Files final : public Assimp::IOSystem {
 public:
  Files(const std::string& scene, SceneFiles& files, ImportedFile& result) : scene_(scene), files_(files), result_(result) {}

  bool Exists(const char* path) const override { return files_.exists(path); }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* /*mode*/) override {
    try {
      return new Stream(opened(path));
    } catch (const core::InputError& error) {
      if (std::find(result_.missing.begin(), result_.missing.end(), error.what()) == result_.missing.end()) {
        result_.missing.emplace_back(error.what());  // Assimp may open a file again and again
      }
      return nullptr;
    }
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::unique_ptr<FileBytes> opened(const std::string& path) {
    if (path == scene_) {
      std::unique_ptr<FileBytes> file = files_.open(path);
      return ending_of(path) == "dae" ? std::make_unique<TextBytes>(collada_in_full(text_of(*file))) : std::move(file);
    }
    return files_.open(path);
  }

  std::string scene_;
  SceneFiles& files_;
  ImportedFile& result_;
};

class LoadProgress final : public Assimp::ProgressHandler {
 public:
  explicit LoadProgress(SceneFiles& files) : files_(files) {}

  bool Update(float share) override {
    files_.show_progress(share >= 0 && share <= 1 ? share : 0);
    return true;
  }
  void UpdateFileRead(int step, int step_count) override {
    Update(step_count > 0 ? static_cast<float>(step) / static_cast<float>(step_count) : 1.0F);
  }

 private:
  SceneFiles& files_;
};

bool reads(Assimp::BaseImporter& reader, const std::string& ending) {
  std::set<std::string> endings;
  reader.GetExtensionList(endings);
  return endings.contains(ending);
}

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

std::vector<std::byte> bytes_of_file(const std::string& path, SceneFiles& files) {
  const std::unique_ptr<FileBytes> file = files.open(path);
  return {file->bytes().begin(), file->bytes().end()};
}

/// Nothing for version 1, which is left to Assimp.
std::optional<ImportedFile> import_gltf(const std::string& path, SceneFiles& files,
                                        const std::optional<AnimationMoment>& animation, core::Copies copies) {
  const std::unique_ptr<FileBytes> file = files.open(path);
  const gltf::Document document = gltf::parse_document(file->bytes());
  if (document.version == 1) {
    return std::nullopt;
  }
  gltf::check_required(document);
  files.expect(gltf::counts_of(document, file->bytes().size(), copies));
  const auto open = [&](const std::string& name) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    const auto found = files.meant(folder, name);
    return bytes_of_file((found.empty() ? folder / name : found.front()).string(), files);
  };
  return gltf::read_gltf(document, open, animation);
}

/// Assimp puts a figure of the tree of nodes in place of meshes that are not there, and marks the scene.
void check_has_mesh(const aiScene& scene, const std::vector<std::string>& notes) {
  if (scene.mNumMeshes == 0 || (scene.mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
    refuse_without_area("there is no mesh in it, and so no triangle that has an area", notes);
  }
}

/// Which may quote the file.
std::string what_assimp_says(const Assimp::Importer& importer, std::string ending) {
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::toupper(c); });
  std::string words = clipped(importer.GetErrorString());
  words.erase(words.find_last_not_of(". ") + 1);
  return "cannot be read as " + ending + ": " + words + ": write it anew, or as another format";
}

}  // namespace

void prepare_import() { static_cast<void>(Assimp::Importer().GetImporterCount()); }

void keep_readers_of(const std::string& ending, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* const reader = importer.GetImporter(i);
    if (!reads(*reader, ending)) {
      importer.UnregisterLoader(reader);
      delete reader;
    }
  }
}

namespace {

/// By Assimp, whose words go into the notes.
void import_by_assimp(const std::string& path, const std::string& ending, SceneFiles& files, ImportedFile& file) {
  const AssimpLog log;
  Assimp::Importer importer;
  keep_readers_of(ending, importer);
  importer.SetIOHandler(new Files(path, files, file));  // is the importer's from now on, and so is the next
  importer.SetProgressHandler(new LoadProgress(files));
  if (importer.ReadFile(path, 0) == nullptr) {
    rethrow_end_of_memory(importer.GetException());
    throw core::InputError(what_assimp_says(importer, ending));
  }
  file.notes.push_back("read by Assimp " + std::to_string(aiGetVersionMajor()) + "." + std::to_string(aiGetVersionMinor()) + "." +
                       std::to_string(aiGetVersionPatch()) + ", single precision");
  log.note(file.notes);
  check_has_mesh(*importer.GetScene(), file.notes);
  file.scene.reset(importer.GetOrphanedScene());
}

}  // namespace

ImportedFile import_file(const std::string& path, SceneFiles& files, const std::optional<AnimationMoment>& animation,
                         core::Copies copies) {
  const std::string ending = ending_of(path);
  if (ending == "gltf" || ending == "glb") {
    if (auto file = import_gltf(path, files, animation, copies)) {
      return *std::move(file);
    }
  }
  if (animation) {
    throw core::InputError("animations are played of glTF 2.0 alone: write the file as such, or leave out --animation");
  }
  const std::unique_ptr<FileBytes> bytes = files.open(path);
  const std::string_view text = text_of(*bytes);
  check_numbers(text, ending);
  check_counts(text, ending);
  ImportedFile file;
  import_by_assimp(path, ending, files, file);
  take_back_invented(*file.scene, ending, text);
  if (ending == "dae") {
    note_loose_bindings(text, file.notes);
    note_collada_losses(text, file.notes);
  }
  if (ending == "fbx") {
    note_count(file.notes, "objects that the file switches off (Visibility or Show), shown all the same",
               count_hidden_nodes(text));
  }
  if (ending == "x") {
    note_count(file.notes,
               "meshes without a material of their own, or of which that is not known, which may have the file's first",
               count_bare_meshes(*file.scene, text));
  }
  return file;
}

}  // namespace dmpc::apps
