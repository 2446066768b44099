// Notes about features of a file that are not shown, with counts or names.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/line/words.h"

namespace dmpc::apps {

/// Appends "WHAT: COUNT" unless the count is 0.
inline void note_count(std::vector<std::string>& notes, const std::string& what, std::uint64_t count) {
  if (count > 0) {
    notes.push_back(what + ": " + grouped(count));
  }
}

/// Counts per kind in the order of first occurrence; the number of kinds is limited, as a file may name as many as it has lines.
class Notes {
 public:
  static constexpr std::size_t kinds_max = 100;

  void count(const std::string& what, std::uint64_t more = 1) {
    for (auto& [known, number] : counts_) {
      if (known == what) {
        number += more;
        return;
      }
    }
    if (more > 0 && counts_.size() < kinds_max) {
      counts_.emplace_back(what, more);
    } else {
      others_ += more;
    }
  }
  void add_to(std::vector<std::string>& notes) const {
    for (const auto& [what, number] : counts_) {
      note_count(notes, what, number);
    }
    note_count(notes, "what of more kinds is not shown as it is, or means nothing where it stands", others_);
  }

 private:
  std::vector<std::pair<std::string, std::uint64_t>> counts_;
  std::uint64_t others_ = 0;
};

/// "a, b, c, d and 3 more".
inline std::string first_of(const std::vector<std::string>& names, std::size_t shown = 4) {
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), shown));
  return joined({names.begin(), end}, ", ") + (names.size() > shown ? " and " + grouped(names.size() - shown) + " more" : "");
}

/// "'a', 'b', 'c', 'd' and 3 more".
inline std::string name_list(std::vector<std::string> names) {
  for (std::string& name : names) {
    name = "'" + clipped(name, 60) + "'";
  }
  return first_of(names);
}

/// Appends "WHAT: NAMES" unless there is none.
inline void note_names(std::vector<std::string>& notes, const std::string& what, const std::vector<std::string>& names) {
  if (!names.empty()) {
    notes.push_back(what + ": " + name_list(names));
  }
}

}  // namespace dmpc::apps
