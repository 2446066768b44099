// A group of primitives cut in two recursively, and the choice of the children of one BVH node.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/database/parallel.h"
#include "core/database/tree/cutter.h"
#include "core/record/record.h"

namespace dmpc::core {

/// A group that fits a leaf, or one with the two parts into which it is cut.
class CutTree {
 public:
  /// Cuts a group until each part fits a leaf. Below the 64th cut, which no reasonable scene reaches, into equal numbers.
  CutTree(Cutter& cutter, const Group& group, const Parallel& parallel, int cuts_above = 0);
  /// Joins two groups of different kinds.
  CutTree(std::unique_ptr<CutTree> first, std::unique_ptr<CutTree> second);

  /// The group of all primitives; for a part that is_leaf(), the group itself.
  const Group& group() const { return group_; }
  bool is_leaf() const { return first_ == nullptr; }

  /// The children of a BVH node for this group: of all choices of at most 8, the one with the least total surface of all BVH
  /// nodes below, so that a ray meets the fewest (dynamic programming as by H. Ylitie, T. Karras, S. Laine, "Efficient Incoherent
  /// Ray Traversal on GPUs Through Compressed Wide BVHs", 2017, over given leaves). For a leaf: itself.
  std::vector<const CutTree*> children() const;
  /// The number of levels of BVH nodes from this group on.
  int levels() const { return is_leaf() ? 1 : levels_[1]; }
  /// The groups of one kind from which this was joined.
  std::vector<Group> kinds() const;

 private:
  static constexpr std::size_t choices = bvh_children_max + 1;

  void weigh();
  void collect(std::size_t count, std::vector<const CutTree*>& found) const;

  Group group_;
  std::unique_ptr<CutTree> first_, second_;
  bool has_kinds_ = false;  ///< its parts are of different kinds
  // Results if this takes at most n of a BVH node's children, at least one, which is a BVH node of its own:
  std::array<float, choices> surface_{};        ///< total of all BVH nodes needed
  std::array<std::uint8_t, choices> levels_{};  ///< levels of those
  std::array<std::uint8_t, choices> share_{};   ///< how many of the n are the first part's; 0: fewer than n suffice
  std::uint8_t bvh_node_share_ = 0;             ///< number of the first part's children in a BVH node for this group
};

}  // namespace dmpc::core
