// What of a text is not followed, by kinds.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/edge/line/number_text.h"
#include "apps/edge/line/shown_text.h"

namespace dmpc::apps::obj {

/// Few kinds, each counted.
class Tally {
 public:
  void add(const std::string& kind, std::uint64_t more = 1) {
    for (auto& [known, count] : counts_) {
      if (known == kind) {
        count += more;
        return;
      }
    }
    counts_.emplace_back(kind, more);
  }
  /// Appends "KIND: COUNT" for each, in the order in which they were met.
  void note(std::vector<std::string>& notes) const {
    for (const auto& [kind, count] : counts_) {
      notes.push_back(kind + ": " + grouped(count));
    }
  }

 private:
  std::vector<std::pair<std::string, std::uint64_t>> counts_;
};

/// Words that no specification knows.
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
