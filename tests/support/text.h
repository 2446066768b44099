// What stands in a text.
#pragma once

#include <cstddef>
#include <string>

namespace dmpc::tests {

/// How often `part`, which is not empty, stands in `text`, overlaps included.
inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace dmpc::tests
