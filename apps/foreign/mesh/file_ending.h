// By what a file's name ends.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace dmpc::apps {

/// "obj": without the dot, in small letters; nothing if there is none.
inline std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending.empty() ? ending : ending.substr(1);
}

}  // namespace dmpc::apps
