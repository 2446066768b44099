#include "core/brick_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/expect.h"
#include "core/overlap.h"

namespace dmpc::core {
namespace {

/// Groups up to this size are cut at the best of all places, larger ones between bins.
constexpr std::size_t exact_cut_max = 64;
constexpr std::size_t bin_count = 32;
constexpr std::uint32_t bound_max = 255;
/// A million grids: kernels cannot overflow, and from where rays need more than that, a float cannot aim at the grid.
constexpr double pad_max = 0x1p20;

/// Half the surface.
double area(const Box& box) {
  const Vec3d size = box.high - box.low;
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

void include(Box& box, const Box& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], other.low[axis]);
    box.high[axis] = std::max(box.high[axis], other.high[axis]);
  }
}

template <class Items>
Box bounds_of_items(const Items& items) {
  Box box;
  for (const auto& item : items) {
    include(box, item.bounds);
  }
  return box;
}

/// The largest number that a brick of `level` may hold without care for balance: what is below it fits however it is cut.
std::size_t carefree_count(int level) { return std::size_t{1} << (3 * (brick_levels_max - level)); }

double blocks_for(std::size_t count) { return static_cast<double>(ceil_divide(count, block_lanes)); }

template <class Item>
bool before(std::size_t axis, const Item& a, const Item& b) {
  const double at_a = a.bounds.low[axis] + a.bounds.high[axis], at_b = b.bounds.low[axis] + b.bounds.high[axis];
  return at_a < at_b || (at_a == at_b && a.id < b.id);
}

template <class Item>
void sort_along(std::size_t axis, std::span<Item> items) {
  std::sort(items.begin(), items.end(), [axis](const Item& a, const Item& b) { return before(axis, a, b); });
}

/// Where to cut, and what a ray that meets the whole pays for the two parts, but for a factor.
struct Cut {
  double cost = std::numeric_limits<double>::infinity();
  std::size_t axis = 0;
  std::size_t place = 0;  ///< how many items, or bins, lie before it
};

/// The best of all cuts between the items in their order along each axis.
template <class Item>
std::size_t cut_exactly(std::span<Item> items) {
  const std::size_t count = items.size();
  std::array<double, exact_cut_max> rest{};
  Cut best;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sort_along(axis, items);
    Box box;
    for (std::size_t i = count; i-- > 1;) {
      include(box, items[i].bounds);
      rest[i] = area(box) * blocks_for(count - i);
    }
    box = Box();
    for (std::size_t i = 1; i < count; ++i) {
      include(box, items[i - 1].bounds);
      const double cost = area(box) * blocks_for(i) + rest[i];
      if (cost < best.cost) {
        best = {cost, axis, i};
      }
    }
  }
  sort_along(best.axis, items);
  return best.place;
}

/// Equal numbers on both sides, along the axis on which the centres are farthest apart.
template <class Item>
std::size_t cut_in_the_middle(std::span<Item> items) {
  Box centers;
  for (const Item& item : items) {
    centers.include(item.bounds.center());
  }
  const Vec3d size = centers.high - centers.low;
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(middle), items.end(),
                   [axis](const Item& a, const Item& b) { return before(axis, a, b); });
  return middle;
}

/// Slices of equal width of where the items' centres lie along an axis.
struct Bins {
  double low, scale;

  template <class Item>
  std::size_t of(const Item& item, std::size_t axis) const {
    const double at = (item.bounds.low[axis] + item.bounds.high[axis] - low) * scale;
    return std::min(static_cast<std::size_t>(std::max(at, 0.0)), bin_count - 1);
  }
};

template <class Item>
Bins bins_along(std::size_t axis, std::span<const Item> items) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Item& item : items) {
    const double at = item.bounds.low[axis] + item.bounds.high[axis];
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return {low, high > low ? static_cast<double>(bin_count) / (high - low) : 0.0};
}

/// The best cut between two bins of an axis (I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007).
template <class Item>
Cut cut_between_bins(std::size_t axis, const Bins& bins, std::span<const Item> items) {
  std::array<Box, bin_count> box{};
  std::array<std::size_t, bin_count> count{};
  for (const Item& item : items) {
    const std::size_t bin = bins.of(item, axis);
    include(box[bin], item.bounds);
    ++count[bin];
  }
  std::array<double, bin_count> rest{};
  Box behind;
  std::size_t items_behind = 0;
  for (std::size_t i = bin_count; i-- > 1;) {
    include(behind, box[i]);
    items_behind += count[i];
    rest[i] = items_behind > 0 ? area(behind) * static_cast<double>(items_behind) : 0.0;
  }
  Cut best;
  Box ahead;
  std::size_t items_ahead = 0;
  for (std::size_t i = 1; i < bin_count; ++i) {
    include(ahead, box[i - 1]);
    items_ahead += count[i - 1];
    const double cost = area(ahead) * static_cast<double>(items_ahead) + rest[i];
    if (items_ahead > 0 && items_ahead < items.size() && cost < best.cost) {
      best = {cost, axis, i};
    }
  }
  return best;
}

template <class Item>
std::size_t cut_by_bins(std::span<Item> items) {
  Cut best;
  std::array<Bins, 3> bins{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bins[axis] = bins_along<Item>(axis, items);
    if (bins[axis].scale > 0) {
      const Cut cut = cut_between_bins<Item>(axis, bins[axis], items);
      best = cut.cost < best.cost ? cut : best;
    }
  }
  if (best.place == 0) {
    return cut_in_the_middle(items);
  }
  const auto second = std::partition(items.begin(), items.end(),
                                     [&](const Item& item) { return bins[best.axis].of(item, best.axis) < best.place; });
  return static_cast<std::size_t>(second - items.begin());
}

/// Reorders the items and says how many come first.
template <class Item>
std::size_t cut(std::span<Item> items, bool balanced) {
  return balanced ? cut_in_the_middle(items) : items.size() <= exact_cut_max ? cut_exactly(items) : cut_by_bins(items);
}

/// The one to be cut next: the largest, or that which costs most; none if all fit blocks.
template <class Group>
std::size_t costliest(const std::vector<Group>& groups, bool balanced) {
  std::size_t found = groups.size();
  double most = -1;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto count = static_cast<double>(groups[i].items.size());
    const double cost = balanced ? count : count * area(groups[i].bounds);
    if (groups[i].items.size() > block_lanes && cost > most) {
      most = cost;
      found = i;
    }
  }
  return found;
}

float rounded_down(double value) {
  const auto rounded = static_cast<float>(value);
  return double{rounded} <= value ? rounded : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}

/// A brick whose bounds reach from `low` to `high`.
Brick brick_over(const Vec3d& low, const Vec3d& high) {
  Brick brick;
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    brick.origin[axis] = rounded_down(low[axis]);
    size = std::max(size, high[axis] - double{brick.origin[axis]});
  }
  int exponent = 0;
  std::frexp(size / bound_max, &exponent);
  brick.unit = std::ldexp(1.0F, exponent);
  return brick;
}

}  // namespace

BrickBuilder::BrickBuilder(std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading, double pad,
                           float finest_cell, RecordWriter& writer)
    : primitives_(primitives),
      shading_(shading),
      pad_(std::min(pad, pad_max)),
      top_edge_(double{finest_cell} * finest_per_top),
      writer_(&writer),
      places_(primitives.size()) {}

Address BrickBuilder::build(const Corner& corner, std::span<const std::uint32_t> ids) {
  if (ids.size() > carefree_count(0)) {
    throw InputError("more than 16,777,216 primitives lie in one place: render a smaller scene");
  }
  std::vector<Item> items = items_of(corner, ids);
  return write_brick(0, by_kind(items));
}

std::vector<BrickBuilder::Item> BrickBuilder::items_of(const Corner& corner, std::span<const std::uint32_t> ids) const {
  Box cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell.low[axis] = corner[axis] / finest_per_top * top_edge_;
    cell.high[axis] = cell.low[axis] + top_edge_;
  }
  cell = cell.padded({pad_, pad_, pad_});
  std::vector<Item> items;
  items.reserve(ids.size());
  for (const std::uint32_t id : ids) {
    const Box whole = bounds_of(primitives_[id]);
    Item item{id, {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      item.bounds.low[axis] = std::clamp(whole.low[axis], cell.low[axis], cell.high[axis]);
      item.bounds.high[axis] = std::clamp(whole.high[axis], cell.low[axis], cell.high[axis]);
    }
    items.push_back(item);
  }
  return items;
}

/// Blocks are of one kind, so the first cuts are between kinds.
std::vector<BrickBuilder::Group> BrickBuilder::by_kind(std::span<Item> items) const {
  const auto kind_of = [&](const Item& item) { return primitives_[item.id].kind; };
  std::stable_sort(items.begin(), items.end(), [&](const Item& a, const Item& b) { return kind_of(a) < kind_of(b); });
  std::vector<Group> groups;
  for (std::size_t first = 0; first < items.size();) {
    std::size_t last = first;
    while (last < items.size() && kind_of(items[last]) == kind_of(items[first])) {
      ++last;
    }
    const auto part = items.subspan(first, last - first);
    groups.push_back({part, bounds_of_items(part)});
    first = last;
  }
  return groups;
}

/// Cuts the groups until there are 8 or each fits a block, and writes the brick, its blocks, and then its bricks.
Address BrickBuilder::write_brick(int level, std::vector<Group> groups) {
  std::size_t count = 0;
  for (const Group& group : groups) {
    count += group.items.size();
  }
  const bool balanced = count > carefree_count(level);
  for (std::size_t i = 0; groups.size() < brick_children_max && (i = costliest(groups, balanced)) < groups.size();) {
    const auto items = groups[i].items;
    const std::size_t first = cut(items, balanced);
    groups[i] = {items.first(first), bounds_of_items(items.first(first))};
    groups.push_back({items.subspan(first), bounds_of_items(items.subspan(first))});
  }
  expect(level < brick_levels_max, "a tree of bricks is no deeper than a walk can go");
  Box bounds;
  for (const Group& group : groups) {
    include(bounds, group.bounds);
  }
  Brick brick = brick_over(bounds.low - Vec3d{pad_, pad_, pad_}, bounds.high + Vec3d{pad_, pad_, pad_});
  set_bounds(brick, groups);
  const Address address = writer_->allocate(sizeof(Brick));
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].items.size() <= block_lanes) {
      brick.child[i] = BrickChild::block(write_block(groups[i]));
    }
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].items.size() > block_lanes) {
      brick.child[i] = BrickChild::brick(write_brick(level + 1, {groups[i]}));
    }
  }
  writer_->write(address, 0, brick);
  return address;
}

void BrickBuilder::set_bounds(Brick& brick, std::span<const Group> groups) const {
  brick.child_count = static_cast<std::uint32_t>(groups.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double origin = double{brick.origin[axis]}, unit = double{brick.unit};
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const Box& box = groups[i].bounds;
      brick.bounds[axis][i] = static_cast<std::uint8_t>(std::floor((box.low[axis] - pad_ - origin) / unit));
      brick.bounds[axis + 3][i] = static_cast<std::uint8_t>(std::ceil((box.high[axis] + pad_ - origin) / unit));
    }
  }
}

Address BrickBuilder::write_block(const Group& group) {
  std::sort(group.items.begin(), group.items.end(), [](const Item& a, const Item& b) { return a.id < b.id; });
  const PrimitiveKind kind = primitives_[group.items[0].id].kind;
  const std::size_t count = group.items.size();
  const Address address = writer_->allocate(block_bytes(kind, count));
  BlockHeader header;
  header.kind = kind;
  header.count = static_cast<std::uint8_t>(count);
  writer_->write(address, 0, header);
  const auto at = [&](std::size_t row, std::size_t lane) { return sizeof(BlockHeader) + 4 * (row * count + lane); };
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::uint32_t id = group.items[lane].id;
    for (std::size_t row = 0; row < value_count(kind); ++row) {
      writer_->write(address, at(row, lane), primitives_[id].value[row]);
    }
    writer_->write(address, at(value_count(kind), lane), id);
    writer_->write(address, at(value_count(kind) + 1, lane), shading_[id]);
    places_[id] = {address, static_cast<std::uint32_t>(lane)};
  }
  references_ += count;
  return address;
}

}  // namespace dmpc::core
