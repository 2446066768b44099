// Case-insensitive words of users and files.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>

namespace dmpc::apps {

inline std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return small;
}

/// Extension of a file's name in small letters, without the point: "gltf".
inline std::string ending_of(const std::filesystem::path& path) {
  const std::string ending = in_small_letters(path.extension().string());
  return ending.substr(ending.empty() ? 0 : 1);
}

}  // namespace dmpc::apps
