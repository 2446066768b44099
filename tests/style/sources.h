// The project's sources, as tests of style go through them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace dmpc::tests {

inline bool is_source(const std::filesystem::path& path) { return path.extension() == ".h" || path.extension() == ".cpp"; }

/// "core/base/vec.h": those below a folder of `root`, relative to it, in order; none if there is no such folder.
inline std::vector<std::string> sources_below(const std::filesystem::path& root, const std::string& folder) {
  std::vector<std::string> files;
  if (std::filesystem::is_directory(root / folder)) {
    for (const std::filesystem::directory_entry& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (entry.is_regular_file() && is_source(entry.path())) {
        files.push_back(std::filesystem::relative(entry.path(), root).generic_string());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace dmpc::tests
