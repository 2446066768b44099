// The result of a trial in one line, the last that a judge prints: what was tried, what failed, the worst case, and where it
// occurred.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/line/number_text.h"

namespace dmpc::apps {

/// Returns "pixel (3, 4)" for a pixel's number in a picture of this width.
inline std::string pixel_text(std::uint64_t pixel, std::uint64_t width) {
  return "pixel (" + std::to_string(pixel % width) + ", " + std::to_string(pixel / width) + ")";
}

struct Trial {
  using Counts = std::vector<std::pair<std::uint64_t, std::string>>;  ///< counts, each with the singular name of what is counted

  Counts tried, failed = {};
  std::string worst = {}, where = {};  ///< empty: nothing was off
};

/// Returns "Tried: 1,200 rays. Failed: nothing. Worst: a silhouette, in pixel (3, 4)."
inline std::string line_of(const Trial& trial) {
  const auto list = [](const Trial::Counts& counts) {
    std::string text;
    for (const auto& [count, thing] : counts) {
      text += count == 0 ? "" : (text.empty() ? "" : ", ") + counted(count, thing);
    }
    return text.empty() ? "nothing" : text;
  };
  return "Tried: " + list(trial.tried) + ". Failed: " + list(trial.failed) +
         ". Worst: " + (trial.worst.empty() ? "nothing was off" : trial.worst + ", in " + trial.where) + ".";
}

}  // namespace dmpc::apps
