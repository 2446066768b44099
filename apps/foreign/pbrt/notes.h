// What of a scene is not shown as it is, by kind.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/foreign/mesh/count_note.h"

namespace dmpc::apps::pbrt {

/// Counts of each kind, in the order in which they come first.
class Notes {
 public:
  void count(const std::string& what, std::uint64_t more = 1) {
    for (auto& [known, number] : counts_) {
      if (known == what) {
        number += more;
        return;
      }
    }
    if (more > 0) {
      counts_.emplace_back(what, more);
    }
  }
  void add_to(std::vector<std::string>& notes) const {
    for (const auto& [what, number] : counts_) {
      note_count(notes, what, number);
    }
  }

 private:
  std::vector<std::pair<std::string, std::uint64_t>> counts_;
};

}  // namespace dmpc::apps::pbrt
