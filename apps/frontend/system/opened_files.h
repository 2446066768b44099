// The files that a scene was read from.
#pragma once

#include <filesystem>
#include <set>
#include <system_error>

namespace dmpc::apps {

/// The paths with links resolved, each once: the scene's own file, and the files that it refers to (materials, textures,
/// buffers).
class OpenedFiles {
 public:
  void add(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::path resolved = std::filesystem::canonical(path, error);
    paths_.insert(error ? path : resolved);
  }
  void add_resolved(const std::filesystem::path& path) { paths_.insert(path); }
  void add(const OpenedFiles& others) { paths_.insert(others.paths_.begin(), others.paths_.end()); }

  const std::set<std::filesystem::path>& paths() const { return paths_; }

 private:
  std::set<std::filesystem::path> paths_;
};

}  // namespace dmpc::apps
