// The environment of a reader of mesh files: access to files, textures, and progress.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/mesh/scene_totals.h"
#include "apps/picture/texture_file.h"

namespace dmpc::apps {

/// A file's bytes, valid during its lifetime.
class FileBytes {
 public:
  virtual ~FileBytes() = default;
  virtual std::span<const std::byte> bytes() const = 0;
};

/// As characters, valid during the file's lifetime.
inline std::string_view text_of(const FileBytes& file) {
  return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

class SceneFiles {
 public:
  explicit SceneFiles(const SceneTotals& totals = SceneTotals()) : totals_(totals) {}
  virtual ~SceneFiles() = default;

  /// Throws core::InputError, a whole sentence, if the file is not available.
  virtual std::unique_ptr<FileBytes> open(const std::string& path) = 0;
  virtual bool exists(const std::string& path) = 0;
  /// As files_meant() of apps/formats/named_file.h.
  virtual std::vector<std::filesystem::path> meant(const std::filesystem::path& folder, const std::string& name) = 0;

  /// Adds the scene's next texture: a picture's file, or one in memory (`format_hint` is an extension, or nothing). Throws
  /// core::InputError "NAME: ..." if it is not available.
  virtual void add_texture(const std::string& path, const TextureEdges& edges) = 0;
  virtual void add_texture(std::span<const std::byte> file, const std::string& name, const std::string& format_hint,
                           const TextureEdges& edges) = 0;
  /// Whether add_texture() only checks the memory for later textures; if it is too small, reading ends.
  virtual void only_weigh_textures(bool /*does*/) {}

  SceneTotals& totals() { return totals_; }
  /// 0 to 1.
  virtual void show_progress(float share) = 0;

 private:
  SceneTotals totals_;
};

}  // namespace dmpc::apps
