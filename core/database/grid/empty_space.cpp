#include "core/database/grid/empty_space.h"

#include <algorithm>
#include <vector>

#include "core/record/directory.h"

namespace dmpc::core {
namespace {

/// A breadth-first search over 26 neighbours.
class Measurement {
 public:
  Measurement(const std::array<std::int32_t, 3>& size, std::span<DirectoryEntry> directory)
      : size_(size), directory_(directory) {}

  void begin() {
    for (Corner top{}; top[2] < size_[2]; ++top[2]) {
      for (top[1] = 0; top[1] < size_[1]; ++top[1]) {
        for (top[0] = 0; top[0] < size_[0]; ++top[0]) {
          if (entry(top).empty()) {
            entry(top).bits = DirectoryEntry::empty_flag | radius_max;
          } else {
            reached_.push_back(top);
          }
        }
      }
    }
  }

  void spread() {
    for (std::uint32_t radius = 1; !reached_.empty() && radius < radius_max; ++radius) {
      std::vector<Corner> next;
      for (const Corner& from : reached_) {
        reach_neighbours(from, radius, next);
      }
      reached_ = std::move(next);
    }
  }

 private:
  DirectoryEntry& entry(const Corner& top) {
    return directory_[directory_index(size_, {top[0] * finest_per_macro, top[1] * finest_per_macro, top[2] * finest_per_macro})];
  }

  void reach_neighbours(const Corner& from, std::uint32_t radius, std::vector<Corner>& next) {
    Corner to;
    for (to[2] = std::max(0, from[2] - 1); to[2] <= std::min(size_[2] - 1, from[2] + 1); ++to[2]) {
      for (to[1] = std::max(0, from[1] - 1); to[1] <= std::min(size_[1] - 1, from[1] + 1); ++to[1]) {
        for (to[0] = std::max(0, from[0] - 1); to[0] <= std::min(size_[0] - 1, from[0] + 1); ++to[0]) {
          if (entry(to).bits == (DirectoryEntry::empty_flag | radius_max)) {
            entry(to).bits = DirectoryEntry::empty_flag | radius;
            next.push_back(to);
          }
        }
      }
    }
  }

  std::array<std::int32_t, 3> size_;
  std::span<DirectoryEntry> directory_;
  std::vector<Corner> reached_;  ///< cells at the last radius
};

}  // namespace

void measure_empty_space(const std::array<std::int32_t, 3>& size, std::span<DirectoryEntry> directory) {
  Measurement measurement(size, directory);
  measurement.begin();
  measurement.spread();
}

}  // namespace dmpc::core
