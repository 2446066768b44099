// Three queues: a small one that most pages only pass through, a main one, and one of remembered names.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/picture/memory_use.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "svm/pages/policy/ghosts.h"
#include "svm/pages/policy/index_lists.h"
#include "svm/pages/replacement.h"

namespace dmpc::svm {

/// J. Yang, Y. Zhang, Z. Qiu, Y. Yue, R. Vinayak, "FIFO Queues are All You Need for Cache Eviction" (SOSP 2023), algorithm 1
/// (S3-FIFO), for pages, which have one size: the small queue has a tenth of the frames, and as many pages are remembered as the
/// main queue has frames. One page is evicted for each that arrives.
class SmallAndMain final : public ReplacementPolicy {
 public:
  explicit SmallAndMain(const PolicySite& site)
      : pages_(site.pages),
        small_max_(small_frames(site.frame_count())),
        main_max_(site.frame_count() - std::min(site.frame_count(), small_max_)),
        frames_(site.memory, site.frame_count()),
        ghosts_(site.memory, ghost_capacity(site.frame_count())),
        hits_(hits_layout(site.frame_count()).in(site.memory)) {}

  static nodes::MemoryPlan layout(std::uint32_t frame_count) {
    return IndexLists::layout(frame_count) + Ghosts::layout(ghost_capacity(frame_count)) + hits_layout(frame_count);
  }

  void hit(PageId /*page*/, std::uint32_t frame) override {
    hits_[frame] = static_cast<std::uint8_t>(std::min<unsigned>(hits_[frame] + 1U, hits_max));
  }

  void insert(PageId /*page*/, std::uint32_t frame) override {
    hits_[frame] = 0;
    frames_.push(comes_back_ ? main : small, frame);
    comes_back_ = false;
  }

  std::uint32_t victim(PageId incoming) override {
    comes_back_ = ghosts_.take(incoming).has_value();
    return frames_.size(small) >= small_max_ ? leave_small() : leave_main();
  }

 private:
  enum List : unsigned { small, main };
  static constexpr std::uint8_t hits_max = 3;
  static nodes::Room<std::uint8_t> hits_layout(std::uint32_t frame_count) { return {core::MemoryUse::page_table, frame_count}; }
  static std::uint32_t small_frames(std::uint32_t frame_count) { return std::max(frame_count / 10, 1U); }
  static std::uint32_t ghost_capacity(std::uint32_t frame_count) {
    return frame_count == 0 ? 0 : std::max(frame_count - small_frames(frame_count), 1U);
  }

  /// Moves pages that were hit more than once to the main queue, evicting from that if it is full.
  std::uint32_t leave_small() {
    while (true) {
      const std::uint32_t frame = frames_.remove_oldest(small);
      if (hits_[frame] <= 1) {
        ghosts_.remember_latest(Ghosts::only_list, pages_[frame]);
        return frame;
      }
      hits_[frame] = 0;
      frames_.push(main, frame);
      if (frames_.size(main) > main_max_) {
        return leave_main();
      }
    }
  }

  /// A hit is worth another round.
  std::uint32_t leave_main() {
    while (true) {
      const std::uint32_t frame = frames_.remove_oldest(main);
      if (hits_[frame] == 0) {
        return frame;
      }
      --hits_[frame];
      frames_.push(main, frame);
    }
  }

  std::span<const PageId> pages_;
  std::uint32_t small_max_, main_max_;
  IndexLists frames_;
  Ghosts ghosts_;
  std::span<std::uint8_t> hits_;  ///< hits of each frame's page, up to 3
  bool comes_back_ = false;
};

}  // namespace dmpc::svm
