// Decides which files a scene may open.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/frontend/system/opened_files.h"
#include "apps/reader/input_file.h"

namespace dmpc::apps {

/// Allowed are a scene's own file, and ordinary files beside and below it, links resolved: beside its given name, or beside its
/// real location. Or any ordinary file.
class FileAccess {
 public:
  /// Finds the scene's file. Throws core::InputError, the end of a sentence "SCENE: ...", if there is none.
  FileAccess(const std::filesystem::path& scene, bool anywhere);

  /// Throws core::InputError, a whole sentence, if there is no such file, or if it may not be opened; ComputerCapacityError if no
  /// further file can be open.
  InputFile open(const std::filesystem::path& path);

  /// Whether open() would find an ordinary file there; false for files that may not be opened.
  bool has(const std::filesystem::path& path) const;

  const OpenedFiles& opened() const { return opened_; }
  const std::filesystem::path& scene() const { return scene_; }

 private:
  bool allows(const std::filesystem::path& resolved) const;

  std::filesystem::path scene_;
  std::vector<std::filesystem::path> folders_;
  bool anywhere_;
  OpenedFiles opened_;
};

}  // namespace dmpc::apps
