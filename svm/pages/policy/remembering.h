// Policies that distinguish pages seen once from pages seen again, by remembering evicted pages.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "nodes/local_memory.h"
#include "svm/pages/policy/ghosts.h"
#include "svm/pages/policy/index_lists.h"
#include "svm/pages/replacement.h"

namespace dmpc::svm {

/// Frames in two lists: new pages, and pages that came back while they were remembered.
class RememberingPolicy : public ReplacementPolicy {
 public:
  void insert(PageId /*page*/, std::uint32_t frame) final {
    frames_.push(comes_back_ ? again : once, frame);
    comes_back_ = false;
  }

 protected:
  enum List : unsigned { once, again };

  RememberingPolicy(const PolicySite& site, std::uint32_t ghost_count)
      : pages_(site.pages), frames_(site.memory, site.frame_count()), ghosts_(site.memory, ghost_count) {}
  static nodes::MemoryPlan layout(std::uint32_t frame_count, std::uint32_t ghost_count) {
    return IndexLists::layout(frame_count) + Ghosts::layout(ghost_count);
  }

  std::span<const PageId> pages_;
  IndexLists frames_;        ///< T1 and T2 of ARC, A1in and Am of 2Q
  Ghosts ghosts_;            ///< B1 and B2; A1out
  bool comes_back_ = false;  ///< the page that is inserted next was remembered
};

/// T. Johnson, D. Shasha, "2Q: A Low Overhead High Performance Buffer Management Replacement Algorithm" (VLDB 1994), the full
/// version: new pages are evicted in the order of arrival, and one that comes back while it is remembered stays until it is the
/// least recently used of those. A quarter of the frames is for new pages, half as many pages as there are frames are remembered.
class TwoQueues final : public RememberingPolicy {
 public:
  explicit TwoQueues(const PolicySite& site)
      : RememberingPolicy(site, ghost_capacity(site.frame_count())), new_pages_max_(std::max(site.frame_count() / 4, 1U)) {}

  static nodes::MemoryPlan layout(std::uint32_t frame_count) {
    return RememberingPolicy::layout(frame_count, ghost_capacity(frame_count));
  }

  /// References soon after the first are not counted: a new page keeps its position in the queue.
  void hit(PageId /*page*/, std::uint32_t frame) override {
    if (frames_.list_of(frame) == again) {
      frames_.remove(frame);
      frames_.push(again, frame);
    }
  }

  std::uint32_t victim(PageId incoming) override {
    comes_back_ = ghosts_.take(incoming).has_value();
    if (frames_.size(once) <= new_pages_max_ && frames_.size(again) > 0) {
      return frames_.remove_oldest(again);
    }
    const std::uint32_t frame = frames_.remove_oldest(once);
    ghosts_.remember_latest(Ghosts::only_list, pages_[frame]);
    return frame;
  }

 private:
  static std::uint32_t ghost_capacity(std::uint32_t frame_count) { return frame_count == 0 ? 0 : std::max(frame_count / 2, 1U); }

  std::uint32_t new_pages_max_;
};

/// N. Megiddo, D. S. Modha, "ARC: A Self-Tuning, Low Overhead Replacement Cache" (FAST 2003), figure 4; its p is an integer here.
/// As many evicted pages are remembered as there are frames.
class AdaptiveReplacement final : public RememberingPolicy {
 public:
  explicit AdaptiveReplacement(const PolicySite& site)
      : RememberingPolicy(site, site.frame_count()), frame_count_(site.frame_count()) {}

  static nodes::MemoryPlan layout(std::uint32_t frame_count) { return RememberingPolicy::layout(frame_count, frame_count); }

  /// Case I.
  void hit(PageId /*page*/, std::uint32_t frame) override {
    frames_.remove(frame);
    frames_.push(again, frame);
  }

  /// Cases II to IV.
  std::uint32_t victim(PageId incoming) override {
    const std::uint32_t once_ghosts = ghosts_.size(once), again_ghosts = ghosts_.size(again);
    const std::optional<unsigned> ghost_list = ghosts_.take(incoming);
    comes_back_ = ghost_list.has_value();
    if (comes_back_) {
      learn(*ghost_list, once_ghosts, again_ghosts);
      return replace(*ghost_list == again);
    }
    if (frames_.size(once) == frame_count_) {
      return frames_.remove_oldest(once);  // not remembered: the list of pages seen once is full
    }
    forget_one();
    return replace(false);
  }

 private:
  /// A page that was evicted too early shows which list should have been longer.
  void learn(unsigned ghost_list, std::uint32_t once_ghosts, std::uint32_t again_ghosts) {
    if (ghost_list == once) {
      once_target_ = std::min(frame_count_, once_target_ + std::max(again_ghosts / once_ghosts, 1U));
    } else {
      once_target_ -= std::min(once_target_, std::max(once_ghosts / again_ghosts, 1U));
    }
  }

  /// If one more would be too many: as many pages seen once are known as there are frames, and twice as many pages in all.
  void forget_one() {
    if (frames_.size(once) + ghosts_.size(once) == frame_count_) {
      ghosts_.forget_oldest(once);
    } else if (ghosts_.size(once) + ghosts_.size(again) == frame_count_) {
      ghosts_.forget_oldest(again);
    }
  }

  std::uint32_t replace(bool was_again) {
    const std::uint32_t once_count = frames_.size(once);
    const bool takes_once = once_count > 0 && (once_count > once_target_ || (was_again && once_count == once_target_));
    const List list = takes_once || frames_.size(again) == 0 ? once : again;
    const std::uint32_t frame = frames_.remove_oldest(list);
    ghosts_.remember(list, pages_[frame]);
    return frame;
  }

  std::uint32_t frame_count_;
  std::uint32_t once_target_ = 0;  ///< p: target number of frames of pages seen once
};

}  // namespace dmpc::svm
