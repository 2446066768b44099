#include "svm/pages/policy/two_queues.h"

#include <algorithm>

namespace dmpc::svm {

std::uint32_t TwoQueues::ghost_capacity(std::uint32_t frame_count) {
  return frame_count == 0 ? 0 : std::max(frame_count / 2, 1U);
}

nodes::MemoryPlan TwoQueues::layout(std::uint32_t frame_count) {
  return IndexLists::layout(frame_count) + Ghosts::layout(ghost_capacity(frame_count));
}

TwoQueues::TwoQueues(const PolicySite& site)
    : pages_(site.pages),
      new_ones_max_(std::max(site.frame_count() / 4, 1U)),
      frames_(site.memory, site.frame_count()),
      ghosts_(site.memory, ghost_capacity(site.frame_count())) {}

/// References soon after the first are taken for one: a new page stays where it is in the queue.
void TwoQueues::hit(PageId /*page*/, std::uint32_t frame) {
  if (frames_.list_of(frame) == kept_ones) {
    frames_.remove(frame);
    frames_.push(kept_ones, frame);
  }
}

void TwoQueues::insert(PageId /*page*/, std::uint32_t frame) {
  frames_.push(comes_back_ ? kept_ones : new_ones, frame);
  comes_back_ = false;
}

std::uint32_t TwoQueues::victim(PageId incoming) {
  comes_back_ = ghosts_.take(incoming).has_value();
  if (frames_.size(new_ones) <= new_ones_max_ && frames_.size(kept_ones) > 0) {
    return frames_.remove_oldest(kept_ones);
  }
  const std::uint32_t frame = frames_.remove_oldest(new_ones);
  ghosts_.remember_latest(Ghosts::only_list, pages_[frame]);
  return frame;
}

}  // namespace dmpc::svm
