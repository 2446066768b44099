// Counts unsupported words of a text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"

namespace dmpc::apps::obj {

/// Words that are not part of the specification.
struct UnknownWords {
  std::uint64_t count = 0;
  std::string first;  ///< "'foo' in line 3"

  void add(std::string_view word, std::size_t line) {
    if (count++ == 0) {
      first = "'" + clipped(word, 60) + "' in line " + std::to_string(line);
    }
  }
  void note(const std::string& what, std::vector<std::string>& notes) const {
    if (count > 0) {
      notes.push_back(what + ": " + grouped(count) + (count == 1 ? ", " : ", the first ") + first);
    }
  }
};

}  // namespace dmpc::apps::obj
