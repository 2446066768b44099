#include "core/brick_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/expect.h"
#include "core/overlap.h"

namespace dmpc::core {
namespace {

constexpr std::uint32_t bound_max = 255;
/// A million grids: kernels cannot overflow, and from where rays need more than that, a float cannot aim at the grid.
constexpr double pad_max = 0x1p20;
/// Bricks of more primitives than this are shared out among threads.
constexpr std::size_t shared_count_min = 8192;

/// The largest number that a brick of `level` may hold without care for balance: what is below it fits however it is cut.
std::size_t carefree_count(int level) { return std::size_t{1} << (3 * (brick_levels_max - level)); }

std::size_t count_of(std::span<const Group> groups) {
  std::size_t count = 0;
  for (const Group& group : groups) {
    count += group.count();
  }
  return count;
}

Bounds bounds_of(std::span<const Group> groups) {
  Bounds bounds;
  for (const Group& group : groups) {
    bounds.include(group.bounds);
  }
  return bounds;
}

/// The one to be cut next: the largest, or that which costs most; none if all fit blocks.
std::size_t costliest(std::span<const Group> groups, bool balanced) {
  std::size_t found = groups.size();
  float most = -1;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto count = static_cast<float>(groups[i].count());
    const float cost = balanced ? count : count * groups[i].bounds.area();
    if (groups[i].count() > block_lanes && cost > most) {
      most = cost;
      found = i;
    }
  }
  return found;
}

/// A brick without children that can hold groups within `bounds`, padded.
Brick brick_over(const Bounds& bounds, double pad) {
  Brick brick;
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    brick.origin[axis] = rounded_down(double{bounds.low[axis]} - pad);
    size = std::max(size, double{bounds.high[axis]} + pad - double{brick.origin[axis]});
  }
  int exponent = 0;
  std::frexp(size / bound_max, &exponent);
  brick.unit = std::ldexp(1.0F, exponent);
  return brick;
}

void add_child(Brick& brick, const Bounds& bounds, double pad) {
  const std::size_t child = brick.child_count++;
  const double unit = double{brick.unit};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double origin = double{brick.origin[axis]};
    brick.bounds[axis][child] = static_cast<std::uint8_t>((double{bounds.low[axis]} - pad - origin) / unit);
    brick.bounds[axis + 3][child] = static_cast<std::uint8_t>(std::ceil((double{bounds.high[axis]} + pad - origin) / unit));
  }
}

}  // namespace

/// Drafts the bricks of one top cell.
class BrickBuilder::Drafter {
 public:
  Drafter(Cutter& cutter, std::span<std::uint32_t> ids, double pad, const Parallel& parallel)
      : cutter_(cutter), ids_(ids), pad_(pad), parallel_(parallel) {}

  /// A brick for the groups, cut until there are 8 or each fits a block.
  BrickDraft draft(int level, std::vector<Group> groups) const {
    expect(level < brick_levels_max, "a tree of bricks is no deeper than a walk can go");
    const std::size_t count = count_of(groups);
    cut(groups, count > carefree_count(level));
    BrickDraft draft{.brick = brick_over(bounds_of(groups), pad_)};
    std::vector<Group> below;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      add_child(draft.brick, groups[i].bounds, pad_);
      if (groups[i].count() <= block_lanes) {
        draft.blocks[i] = block_of(groups[i]);
      } else {
        below.push_back(groups[i]);
      }
    }
    draft.bricks.resize(below.size());
    const auto draft_below = [&](std::size_t i) { draft.bricks[i] = this->draft(level + 1, {below[i]}); };
    if (count > shared_count_min) {
      parallel_.for_each(below.size(), draft_below);
    } else {
      for (std::size_t i = 0; i < below.size(); ++i) {
        draft_below(i);
      }
    }
    return draft;
  }

 private:
  void cut(std::vector<Group>& groups, bool balanced) const {
    groups.reserve(brick_children_max);
    for (std::size_t i = 0; groups.size() < brick_children_max && (i = costliest(groups, balanced)) < groups.size();) {
      const auto [first, second] = cutter_.cut(groups[i], balanced);
      groups[i] = first;
      groups.push_back(second);
    }
  }

  BrickDraft::Block block_of(const Group& group) const {
    const auto ids = ids_.subspan(group.first, group.count());
    cutter_.copy_ids(group, ids);
    std::sort(ids.begin(), ids.end());
    return {group.first, static_cast<std::uint8_t>(group.count()), group.kind};
  }

  Cutter& cutter_;
  std::span<std::uint32_t> ids_;
  double pad_;
  const Parallel& parallel_;
};

BrickBuilder::BrickBuilder(std::span<const PrimitiveValues> primitives, double pad, float finest_cell, const Parallel& parallel)
    : primitives_(primitives),
      pad_(std::min(pad, pad_max)),
      top_edge_(double{finest_cell} * finest_per_top),
      parallel_(&parallel) {}

BrickTree BrickBuilder::build(const Corner& corner, std::span<const std::uint32_t> ids) const {
  if (ids.size() > carefree_count(0)) {
    throw InputError("more than 16,777,216 primitives lie in one place: render a smaller scene");
  }
  Cutter cutter(ids.size());
  std::vector<Group> groups = add_by_kind(cell_at(corner), ids, cutter);
  BrickTree tree{.top = {}, .ids = std::vector<std::uint32_t>(ids.size())};
  tree.top = Drafter(cutter, tree.ids, pad_, *parallel_).draft(0, std::move(groups));
  return tree;
}

Bounds BrickBuilder::cell_at(const Corner& corner) const {
  Box cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell.low[axis] = corner[axis] / finest_per_top * top_edge_;
    cell.high[axis] = cell.low[axis] + top_edge_;
  }
  return Bounds::around(cell.padded({pad_, pad_, pad_}));
}

/// Blocks are of one kind, so the first cuts are between kinds.
std::vector<Group> BrickBuilder::add_by_kind(const Bounds& cell, std::span<const std::uint32_t> ids, Cutter& cutter) const {
  std::vector<Group> groups;
  std::size_t first = 0;
  for (std::size_t kind = 0; kind < primitive_kind_count; ++kind) {
    std::size_t last = first;
    for (const std::uint32_t id : ids) {
      const PrimitiveValues& primitive = primitives_[id];
      if (static_cast<std::size_t>(primitive.kind) == kind) {
        cutter.add(id, rounded_bounds_of(primitive).clamped_to(cell));
        ++last;
      }
    }
    if (last > first) {
      groups.push_back(cutter.group(static_cast<PrimitiveKind>(kind), first, last));
    }
    first = last;
  }
  return groups;
}

}  // namespace dmpc::core
