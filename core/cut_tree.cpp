#include "core/cut_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace dmpc::core {
namespace {

/// Groups of more primitives than this are shared out among threads.
constexpr std::uint32_t shared_count_min = 8192;

}  // namespace

CutTree::CutTree(Cutter& cutter, const Group& group, bool balanced, const Parallel& parallel) : group_(group) {
  if (group.count() <= block_lanes) {
    return;
  }
  const std::pair<Group, Group> parts = cutter.cut(group, balanced);
  const auto cut_part = [&](std::size_t part) {
    (part == 0 ? first_ : second_) =
        std::make_unique<CutTree>(cutter, part == 0 ? parts.first : parts.second, balanced, parallel);
  };
  if (group.count() > shared_count_min) {
    parallel.for_each(2, cut_part);
  } else {
    cut_part(0);
    cut_part(1);
  }
  weigh();
}

CutTree::CutTree(std::unique_ptr<CutTree> first, std::unique_ptr<CutTree> second)
    : group_(first->group_), first_(std::move(first)), second_(std::move(second)) {
  group_.last = second_->group_.last;
  group_.bounds.include(second_->group_.bounds);
  weigh();
}

void CutTree::weigh() {
  constexpr float worst = std::numeric_limits<float>::infinity();
  const auto best_share = [&](std::size_t count, float& least) {
    std::uint8_t best = 0;
    for (std::size_t share = 1; share < count; ++share) {
      const float sum = first_->surface_[share] + second_->surface_[count - share];
      if (sum < least) {
        least = sum;
        best = static_cast<std::uint8_t>(share);
      }
    }
    return best;
  };
  float inside = worst;
  brick_share_ = best_share(brick_children_max, inside);
  surface_[0] = worst;
  surface_[1] = group_.bounds.area() + inside;
  for (std::size_t count = 2; count < choices; ++count) {
    surface_[count] = surface_[count - 1];
    share_[count] = best_share(count, surface_[count]);
  }
}

std::vector<const CutTree*> CutTree::children() const {
  std::vector<const CutTree*> found;
  found.reserve(brick_children_max);
  if (is_block()) {
    found.push_back(this);
  } else {
    first_->collect(brick_share_, found);
    second_->collect(brick_children_max - brick_share_, found);
  }
  return found;
}

/// The parts that are children if this takes `count` of them.
void CutTree::collect(std::size_t count, std::vector<const CutTree*>& found) const {
  while (count > 1 && share_[count] == 0) {
    --count;
  }
  if (count == 1) {
    found.push_back(this);
  } else {
    first_->collect(share_[count], found);
    second_->collect(count - share_[count], found);
  }
}

std::vector<const CutTree*> CutTree::eighths() const {
  std::vector<const CutTree*> found;
  collect_below(3, found);
  return found;
}

void CutTree::collect_below(int cuts, std::vector<const CutTree*>& found) const {
  if (is_block() || cuts == 0) {
    found.push_back(this);
  } else {
    first_->collect_below(cuts - 1, found);
    second_->collect_below(cuts - 1, found);
  }
}

int CutTree::levels() const {
  int below = 0;
  for (const CutTree* child : children()) {
    below = std::max(below, child->is_block() ? 0 : child->levels());
  }
  return below + 1;
}

}  // namespace dmpc::core
