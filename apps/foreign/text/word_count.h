// How many words a text has: a look at each byte, ten times faster than reading them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dmpc::apps {

/// What lies between blanks and line ends, remarks included.
inline std::uint64_t count_words(std::string_view text) {
  std::uint64_t count = 0;
  bool was_blank = true;
  for (const char letter : text) {
    const bool is_blank = static_cast<unsigned char>(letter) <= ' ';
    count += was_blank && !is_blank ? 1 : 0;
    was_blank = is_blank;
  }
  return count;
}

}  // namespace dmpc::apps
