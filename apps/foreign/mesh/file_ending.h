// By what a file's name ends.
#pragma once

#include <filesystem>
#include <string>

#include "apps/foreign/text/small_letters.h"

namespace dmpc::apps {

/// "obj": without the dot, in small letters; nothing if there is none.
inline std::string ending_of(const std::string& path) {
  const std::string ending = in_small_letters(std::filesystem::path(path).extension().string());
  return ending.empty() ? ending : ending.substr(1);
}

}  // namespace dmpc::apps
