#include "svm/pages/policy/small_and_main.h"

#include <algorithm>

#include "core/picture/memory_use.h"

namespace dmpc::svm {
namespace {

constexpr std::uint8_t hits_max = 3;

nodes::Room<std::uint8_t> hits_layout(std::uint32_t frame_count) { return {core::MemoryUse::page_table, frame_count}; }

}  // namespace

std::uint32_t SmallAndMain::small_frames(std::uint32_t frame_count) { return std::max(frame_count / 10, 1U); }

std::uint32_t SmallAndMain::ghost_capacity(std::uint32_t frame_count) {
  return frame_count == 0 ? 0 : std::max(frame_count - small_frames(frame_count), 1U);
}

nodes::MemoryPlan SmallAndMain::layout(std::uint32_t frame_count) {
  return IndexLists::layout(frame_count) + Ghosts::layout(ghost_capacity(frame_count)) + hits_layout(frame_count);
}

SmallAndMain::SmallAndMain(const PolicySite& site)
    : pages_(site.pages),
      small_max_(small_frames(site.frame_count())),
      main_max_(site.frame_count() - std::min(site.frame_count(), small_max_)),
      frames_(site.memory, site.frame_count()),
      ghosts_(site.memory, ghost_capacity(site.frame_count())),
      hits_(hits_layout(site.frame_count()).in(site.memory)) {}

void SmallAndMain::hit(PageId /*page*/, std::uint32_t frame) {
  hits_[frame] = static_cast<std::uint8_t>(std::min<unsigned>(hits_[frame] + 1U, hits_max));
}

void SmallAndMain::insert(PageId /*page*/, std::uint32_t frame) {
  hits_[frame] = 0;
  frames_.push(comes_back_ ? main : small, frame);
  comes_back_ = false;
}

std::uint32_t SmallAndMain::victim(PageId incoming) {
  comes_back_ = ghosts_.take(incoming).has_value();
  return frames_.size(small) >= small_max_ ? leave_small() : leave_main();
}

/// Pages that were hit more than once go over to the main queue, and out of that if it is full.
std::uint32_t SmallAndMain::leave_small() {
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
std::uint32_t SmallAndMain::leave_main() {
  while (true) {
    const std::uint32_t frame = frames_.remove_oldest(main);
    if (hits_[frame] == 0) {
      return frame;
    }
    --hits_[frame];
    frames_.push(main, frame);
  }
}

}  // namespace dmpc::svm
