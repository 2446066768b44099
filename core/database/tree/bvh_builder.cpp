#include "core/database/tree/bvh_builder.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/expect.h"
#include "core/database/tree/overlap.h"

namespace dmpc::core {
namespace {

/// A million grids: kernels cannot overflow, and floats cannot aim at the grid from where rays would need more.
constexpr double pad_max = 0x1p20;

/// The maximum number of groups of one kind that may still be cut without regard to balance with this many `levels` of BVH nodes
/// left. Even if one child gets nearly all of them, the levels below can hold them, cut evenly: 8 in each child of each BVH node.
std::size_t carefree_count(int levels) { return std::size_t{1} << (3 * levels); }

/// The weight of a group: each face that needs a plane may need a leaf of its own.
std::size_t weight_of(const Group& group) { return group.count() * (group.needs_plane ? leaf_lanes : 1); }

std::size_t weight_of(std::span<const Group> groups) {
  std::size_t weight = 0;
  for (const Group& group : groups) {
    weight += weight_of(group);
  }
  return weight;
}

/// In the worst case a part of two kinds is cut evenly into 7 groups of one kind and 1 of the other, so the largest has a quarter
/// of all, not an eighth.
std::size_t carefree_count(const CutTree& tree, int levels) {
  return tree.kinds().size() == 1 ? carefree_count(levels) : carefree_count(levels) / 2;
}

/// Cuts groups into equal numbers until there are 8 groups or each fits a leaf.
void cut_evenly(std::vector<Group>& groups, Cutter& cutter) {
  const auto smaller = [](const Group& a, const Group& b) { return weight_of(a) < weight_of(b); };
  while (groups.size() < bvh_children_max) {
    Group& largest = *std::max_element(groups.begin(), groups.end(), smaller);
    if (weight_of(largest) <= leaf_lanes) {
      return;
    }
    const auto [first, second] = cutter.cut(largest, true);
    largest = first;
    groups.push_back(second);
  }
}

}  // namespace

/// Drafts the BVH nodes of one macro cell.
class BvhBuilder::Drafter {
 public:
  Drafter(Cutter& cutter, std::span<std::uint32_t> ids, double pad, const Parallel& parallel)
      : cutter_(cutter), ids_(ids), pad_(pad), parallel_(parallel) {}

  /// `levels` is the number of levels that are left.
  BvhNodeDraft draft(const CutTree& tree, int levels) const {
    expect(levels > 0, "a tree of BVH nodes is no deeper than a traversal can go");
    const bool too_deep = tree.levels() > levels && weight_of(tree.kinds()) > carefree_count(tree, levels);
    return too_deep ? draft_evenly(tree, levels) : draft_over(tree.group().bounds, tree.children(), levels);
  }

 private:
  BvhNodeDraft draft_over(const Bounds& bounds, const std::vector<const CutTree*>& children, int levels) const {
    BvhNodeDraft draft{.bvh_node = bvh_node_over(bounds, pad_)};
    for (std::size_t i = 0; i < children.size(); ++i) {
      add_child(draft.bvh_node, children[i]->group().bounds, pad_);
      if (children[i]->is_leaf()) {
        draft.leaves[i] = leaf_of(children[i]->group());
      } else {
        draft.bvh_nodes.push_back(this->draft(*children[i], levels - 1));
      }
    }
    return draft;
  }

  /// Gives children equal numbers, so that the remaining levels suffice.
  BvhNodeDraft draft_evenly(const CutTree& tree, int levels) const {
    std::vector<Group> groups = tree.kinds();
    for (const Group& group : groups) {
      cutter_.sort_again(group);  // the tree was cut from it
    }
    cut_evenly(groups, cutter_);
    std::vector<CutTree> parts;
    std::vector<const CutTree*> children;
    parts.reserve(groups.size());
    for (const Group& group : groups) {
      children.push_back(&parts.emplace_back(cutter_, group, parallel_));
    }
    return draft_over(tree.group().bounds, children, levels);
  }

  BvhNodeDraft::Leaf leaf_of(const Group& group) const {
    const auto ids = ids_.subspan(group.first, group.count());
    cutter_.copy_ids(group, ids);
    std::sort(ids.begin(), ids.end());
    return {group.first, static_cast<std::uint8_t>(group.count()), group.kind, cutter_.plane_of(group)};
  }

  Cutter& cutter_;
  std::span<std::uint32_t> ids_;
  double pad_;
  const Parallel& parallel_;
};

BvhBuilder::BvhBuilder(std::span<const PrimitiveValues> primitives, double pad, const GridFrame& frame, const Parallel& parallel,
                       int levels_max)
    : primitives_(primitives), pad_(std::min(pad, pad_max)), frame_(frame), parallel_(&parallel), levels_max_(levels_max) {}

BvhTree BvhBuilder::build(const Corner& corner, std::span<const std::uint32_t> ids) const {
  Cutter cutter(ids.size(), primitives_);
  const std::vector<Group> kinds = add_by_kind(cell_at(corner), ids, cutter);
  if (const std::size_t most = carefree_count(levels_max_), weight = weight_of(kinds); weight > most) {
    throw CapacityError(
        std::to_string(weight) + " primitives lie in one place, at most " + std::to_string(most) +
        " may (triangles that cover others in their plane count eightfold): spread them out, or render a smaller scene" +
        (levels_max_ < bvh_levels_max ? "; without places of base meshes eight times as many may" : ""));
  }
  const CutTree cuts = cut(kinds, cutter);
  BvhTree tree{.top = {}, .ids = std::vector<std::uint32_t>(ids.size())};
  tree.top = Drafter(cutter, tree.ids, pad_, *parallel_).draft(cuts, levels_max_);
  return tree;
}

/// A leaf holds only one kind, with planes or without, so the first cuts separate kinds.
CutTree BvhBuilder::cut(std::span<const Group> kinds, Cutter& cutter) const {
  auto tree = std::make_unique<CutTree>(cutter, kinds[0], *parallel_);
  for (const Group& kind : kinds.subspan(1)) {
    tree = std::make_unique<CutTree>(std::move(tree), std::make_unique<CutTree>(cutter, kind, *parallel_));
  }
  return std::move(*tree);
}

Bounds BvhBuilder::cell_at(const Corner& corner) const {
  Box cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell.low[axis] = plane_at(frame_, axis, corner[axis]);
    cell.high[axis] = plane_at(frame_, axis, corner[axis] + finest_per_macro);
  }
  return Bounds::around(cell.padded({pad_, pad_, pad_}));
}

/// The groups by kind: triangles, then triangles that need planes, then the others.
std::vector<Group> BvhBuilder::add_by_kind(const Bounds& cell, std::span<const std::uint32_t> ids, Cutter& cutter) const {
  std::vector<Group> groups;
  std::size_t first = 0;
  bool is_any_left = false;
  const auto add = [&](PrimitiveKind kind, bool needs_plane) {
    std::size_t last = first;
    for (const std::uint32_t id : ids) {
      const PrimitiveValues& primitive = primitives_[id];
      if (primitive.kind != kind) {
        continue;
      }
      if (primitive.needs_plane() == needs_plane) {
        cutter.add(id, rounded_bounds_of(primitive).clamped_to(cell));
        ++last;
      } else {
        is_any_left = true;
      }
    }
    if (last > first) {
      groups.push_back(cutter.group(kind, first, last, needs_plane));
    }
    first = last;
  };
  for (const PrimitiveKind kind :
       {PrimitiveKind::triangle, PrimitiveKind::sphere, PrimitiveKind::cone, PrimitiveKind::instance}) {
    if (first == ids.size()) {
      break;  // usually all are of one kind
    }
    add(kind, false);
    if (is_any_left && kind == PrimitiveKind::triangle) {
      add(kind, true);
    }
  }
  return groups;
}

}  // namespace dmpc::core
