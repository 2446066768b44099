// Pages seen once beside pages seen again, with a border that learns.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "nodes/local_memory.h"
#include "svm/pages/policy/ghosts.h"
#include "svm/pages/policy/index_lists.h"
#include "svm/pages/policy/policy.h"

namespace dmpc::svm {

/// N. Megiddo, D. S. Modha, "ARC: A Self-Tuning, Low Overhead Replacement Cache" (FAST 2003), figure 4; its p is a whole number
/// here. As many pages that have left are remembered as there are frames.
class AdaptiveReplacement final : public ReplacementPolicy {
 public:
  explicit AdaptiveReplacement(const PolicySite& site)
      : pages_(site.pages),
        frame_count_(site.frame_count()),
        frames_(site.memory, site.frame_count()),
        ghosts_(site.memory, site.frame_count()) {}

  static nodes::MemoryPlan layout(std::uint32_t frame_count) {
    return IndexLists::layout(frame_count) + Ghosts::layout(frame_count);
  }

  /// Case I.
  void hit(PageId /*page*/, std::uint32_t frame) override {
    frames_.remove(frame);
    frames_.push(again, frame);
  }

  void insert(PageId /*page*/, std::uint32_t frame) override {
    frames_.push(comes_back_ ? again : once, frame);
    comes_back_ = false;
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
      return frames_.remove_oldest(once);  // and nobody remembers it: as many were seen once as are to be known
    }
    forget_one();
    return replace(false);
  }

 private:
  enum List : unsigned { once, again };

  /// A page that left too early says which list should have been longer.
  void learn(unsigned ghost_list, std::uint32_t once_ghosts, std::uint32_t again_ghosts) {
    if (ghost_list == once) {
      once_target_ = std::min(frame_count_, once_target_ + std::max(again_ghosts / once_ghosts, 1U));
    } else {
      once_target_ -= std::min(once_target_, std::max(once_ghosts / again_ghosts, 1U));
    }
  }

  /// Where one more would be too many: as many pages seen once are known as there are frames, and twice as many pages in all.
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

  std::span<const PageId> pages_;
  std::uint32_t frame_count_;
  IndexLists frames_;              ///< T1 and T2
  Ghosts ghosts_;                  ///< B1 and B2
  std::uint32_t once_target_ = 0;  ///< p: frames that pages seen once should have
  bool comes_back_ = false;        ///< the page that is inserted next was remembered
};

}  // namespace dmpc::svm
