#include "core/database/tree/cut_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::core {
namespace {

/// Groups of more primitives than this are split among threads.
constexpr std::uint32_t shared_count_min = 8192;
/// The maximum number of nested cuts without regard to balance, which keeps the tree shallow for any input.
constexpr int careless_cuts_max = 64;

}  // namespace

CutTree::CutTree(Cutter& cutter, const Group& group, const Parallel& parallel, int cuts_above) : group_(group) {
  if (cutter.fits_leaf(group)) {
    return;
  }
  const auto parts = cutter.cut(group, cuts_above >= careless_cuts_max);
  const auto cut_part = [&](std::size_t part) {
    (part == 0 ? first_ : second_) =
        std::make_unique<CutTree>(cutter, part == 0 ? parts.first : parts.second, parallel, cuts_above + 1);
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
    : group_(first->group_), first_(std::move(first)), second_(std::move(second)), has_kinds_(true) {
  group_.last = second_->group_.last;
  group_.bounds.include(second_->group_.bounds);
  weigh();
}

/// Finds the best choices from those of the two parts.
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
  const auto levels_below = [&](std::size_t share, std::size_t count) {
    return std::max(first_->levels_[share], second_->levels_[count - share]);
  };
  float inside = worst;
  bvh_node_share_ = best_share(bvh_children_max, inside);
  expect(bvh_node_share_ > 0, "the surfaces of BVH nodes are finite");
  surface_[1] = group_.bounds.area() + inside;
  levels_[1] = static_cast<std::uint8_t>(levels_below(bvh_node_share_, bvh_children_max) + 1);
  for (std::size_t count = 2; count < choices; ++count) {
    surface_[count] = surface_[count - 1];
    share_[count] = best_share(count, surface_[count]);
    levels_[count] = share_[count] == 0 ? levels_[count - 1] : levels_below(share_[count], count);
  }
}

std::vector<const CutTree*> CutTree::children() const {
  std::vector<const CutTree*> found;
  found.reserve(bvh_children_max);
  if (is_leaf()) {
    found.push_back(this);
  } else {
    first_->collect(bvh_node_share_, found);
    second_->collect(bvh_children_max - bvh_node_share_, found);
  }
  return found;
}

/// Collects the parts that become children if this node gets `count` of them.
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

std::vector<Group> CutTree::kinds() const {
  if (!has_kinds_) {
    return {group_};
  }
  std::vector<Group> kinds = first_->kinds();
  for (const Group& kind : second_->kinds()) {
    kinds.push_back(kind);
  }
  return kinds;
}

}  // namespace dmpc::core
