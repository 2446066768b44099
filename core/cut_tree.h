// A group of primitives cut in two again and again, and which of the parts become children of one brick.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/cutter.h"
#include "core/parallel.h"
#include "core/record.h"

namespace dmpc::core {

/// A group that fits a block, or one with the two parts it is cut into.
class CutTree {
 public:
  /// Cuts a group until each part fits a block. `balanced`: into parts of equal numbers.
  CutTree(Cutter& cutter, const Group& group, bool balanced, const Parallel& parallel);
  /// Two groups, such as of different kinds, as if they were parts of one.
  CutTree(std::unique_ptr<CutTree> first, std::unique_ptr<CutTree> second);

  /// Of all primitives; for a part that is_block(), the group itself.
  const Group& group() const { return group_; }
  bool is_block() const { return first_ == nullptr; }

  /// The children of a brick for this group, of all choices of at most 8 that with which the surfaces of all bricks below are
  /// smallest, so that a ray meets the fewest (dynamic programming as by H. Ylitie, T. Karras, S. Laine, "Efficient Incoherent
  /// Ray Traversal on GPUs Through Compressed Wide BVHs", 2017, over blocks that are fixed). Of a block: itself.
  std::vector<const CutTree*> children() const;
  /// The parts after three cuts: of a balanced tree the choice with the fewest levels.
  std::vector<const CutTree*> eighths() const;

  /// How many levels of bricks children() leads to.
  int levels() const;

 private:
  static constexpr std::size_t choices = brick_children_max + 1;

  void weigh();
  void collect(std::size_t count, std::vector<const CutTree*>& found) const;
  void collect_below(int cuts, std::vector<const CutTree*>& found) const;

  Group group_;
  std::unique_ptr<CutTree> first_, second_;
  /// Surfaces of the bricks needed if this takes n of a brick's children, and how many of those are the first part's; 0: fewer
  /// than n will do, at last one, a brick of its own.
  std::array<float, choices> surface_{};
  std::array<std::uint8_t, choices> share_{};
  std::uint8_t brick_share_ = 0;  ///< the first part's children in a brick for this group
};

}  // namespace dmpc::core
