// What of a scene is not shown as it is, by kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/foreign/mesh/count_note.h"

namespace dmpc::apps::pbrt {

/// Counts of each kind, in the order in which they come first: of so many kinds each, as a file may name as many as it has lines.
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

}  // namespace dmpc::apps::pbrt
