// Names of strangers as a part of a sentence.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "apps/edge/line/number_text.h"
#include "apps/edge/line/shown_text.h"

namespace dmpc::apps {

/// "'a', 'b', 'c', 'd' and 3 more".
inline std::string name_list(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 4;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), shown); ++i) {
    list += (i > 0 ? ", '" : "'") + clipped(names[i], 60) + "'";
  }
  return list + (names.size() > shown ? " and " + grouped(names.size() - shown) + " more" : "");
}

/// Appends "WHAT: NAMES" unless there is none.
inline void note_names(std::vector<std::string>& notes, const std::string& what, const std::vector<std::string>& names) {
  if (!names.empty()) {
    notes.push_back(what + ": " + name_list(names));
  }
}

}  // namespace dmpc::apps
