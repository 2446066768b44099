// Words that files may write in any letters.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace dmpc::apps {

inline std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return small;
}

}  // namespace dmpc::apps
