// A queue for pages that are new, and a list for those that came back.
#pragma once

#include <algorithm>
#include <cstdint>

#include "nodes/local_memory.h"
#include "svm/pages/policy/ghosts.h"
#include "svm/pages/policy/index_lists.h"
#include "svm/pages/policy/policy.h"

namespace dmpc::svm {

/// T. Johnson, D. Shasha, "2Q: A Low Overhead High Performance Buffer Management Replacement Algorithm" (VLDB 1994), the full
/// version: new pages leave in the order in which they came, and one that comes back while it is remembered stays until it is the
/// least recently used of those. A quarter of the frames is for new pages, half as many pages as there are frames are remembered.
class TwoQueues final : public ReplacementPolicy {
 public:
  explicit TwoQueues(const PolicySite& site)
      : pages_(site.pages),
        new_ones_max_(std::max(site.frame_count() / 4, 1U)),
        frames_(site.memory, site.frame_count()),
        ghosts_(site.memory, ghost_capacity(site.frame_count())) {}

  static nodes::MemoryPlan layout(std::uint32_t frame_count) {
    return IndexLists::layout(frame_count) + Ghosts::layout(ghost_capacity(frame_count));
  }

  /// References soon after the first are taken for one: a new page stays where it is in the queue.
  void hit(PageId /*page*/, std::uint32_t frame) override {
    if (frames_.list_of(frame) == kept_ones) {
      frames_.remove(frame);
      frames_.push(kept_ones, frame);
    }
  }

  void insert(PageId /*page*/, std::uint32_t frame) override {
    frames_.push(comes_back_ ? kept_ones : new_ones, frame);
    comes_back_ = false;
  }

  std::uint32_t victim(PageId incoming) override {
    comes_back_ = ghosts_.take(incoming).has_value();
    if (frames_.size(new_ones) <= new_ones_max_ && frames_.size(kept_ones) > 0) {
      return frames_.remove_oldest(kept_ones);
    }
    const std::uint32_t frame = frames_.remove_oldest(new_ones);
    ghosts_.remember_latest(Ghosts::only_list, pages_[frame]);
    return frame;
  }

 private:
  enum List : unsigned { new_ones, kept_ones };
  static std::uint32_t ghost_capacity(std::uint32_t frame_count) { return frame_count == 0 ? 0 : std::max(frame_count / 2, 1U); }

  std::span<const PageId> pages_;
  std::uint32_t new_ones_max_;
  IndexLists frames_;  ///< A1in and Am
  Ghosts ghosts_;      ///< A1out
  bool comes_back_ = false;
};

}  // namespace dmpc::svm
