// Sentences about what of a file is not shown, by how much there is of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/edge/line/number_text.h"

namespace dmpc::apps {

/// Appends "WHAT: COUNT" unless the count is 0.
inline void note_count(std::vector<std::string>& notes, const std::string& what, std::uint64_t count) {
  if (count > 0) {
    notes.push_back(what + ": " + grouped(count));
  }
}

}  // namespace dmpc::apps
