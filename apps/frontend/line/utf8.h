// The characters of a text that should be UTF-8.
#pragma once

#include <cstddef>
#include <string_view>

namespace dmpc::apps {

struct Utf8Character {
  std::size_t bytes = 0;  ///< 0: the text does not begin with a character
  char32_t code = 0;
};

/// The character at the front of `text`, which is not empty.
Utf8Character first_character(std::string_view text);
/// Whether `text`, which is not empty, is an incomplete character that further bytes may complete.
bool is_cut_character(std::string_view text);

}  // namespace dmpc::apps
