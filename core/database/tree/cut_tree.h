// A group of primitives cut in two again and again, and which of the parts become children of one BVH node.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/database/parallel.h"
#include "core/database/tree/cutter.h"
#include "core/record/record.h"

namespace dmpc::core {

/// A group that fits a leaf, or one with the two parts it is cut into.
class CutTree {
 public:
  /// Cuts a group until each part fits a leaf. Below the 64th cut, which no sensible scene comes to, into equal numbers.
  CutTree(Cutter& cutter, const Group& group, const Parallel& parallel, int cuts_above = 0);
  /// Two groups of different kinds as if they were the parts of one.
  CutTree(std::unique_ptr<CutTree> first, std::unique_ptr<CutTree> second);

  /// The group of all primitives; for a part that is_leaf(), the group itself.
  const Group& group() const { return group_; }
  bool is_leaf() const { return first_ == nullptr; }

  /// The children of a BVH node for this group, of all choices of at most 8 that with which the surfaces of all BVH nodes below
  /// are smallest together, so that a ray meets the fewest (dynamic programming as by H. Ylitie, T. Karras, S. Laine, "Efficient
  /// Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", 2017, over leaves that are given). Of a leaf: itself.
  std::vector<const CutTree*> children() const;
  /// How many levels of BVH nodes children() leads to, that of this group included.
  int levels() const { return is_leaf() ? 1 : levels_[1]; }
  /// The groups of one kind that this was put together from.
  std::vector<Group> kinds() const;

 private:
  static constexpr std::size_t choices = bvh_children_max + 1;

  void weigh();
  void collect(std::size_t count, std::vector<const CutTree*>& found) const;

  Group group_;
  std::unique_ptr<CutTree> first_, second_;
  bool has_kinds_ = false;  ///< its parts are of different kinds
  // What becomes of this if it takes n of a BVH node's children, or fewer, at least one, which is a BVH node of its own:
  std::array<float, choices> surface_{};        ///< that of all BVH nodes needed
  std::array<std::uint8_t, choices> levels_{};  ///< of those BVH nodes
  std::array<std::uint8_t, choices> share_{};   ///< how many of the n are the first part's; 0: fewer than n will do
  std::uint8_t bvh_node_share_ = 0;             ///< the first part's children in a BVH node for this group
};

}  // namespace dmpc::core
