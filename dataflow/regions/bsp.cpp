#include "dataflow/regions/bsp.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>

#include "core/base/units.h"

namespace dmpc::dataflow {
namespace {

/// The weight of a finest column's area beside its load, as a share of the mean load of a finest column: too little to disturb
/// the balance, but enough to put a cut through empty space in its middle.
constexpr double area_share = 1e-6;

/// A half-open rectangle of finest columns along the two cut axes.
struct Rectangle {
  std::array<std::int32_t, 2> low{}, high{};

  std::int32_t length(std::size_t along) const { return high[along] - low[along]; }
  std::int64_t area() const { return std::int64_t{length(0)} * length(1); }
};

/// The share, in [0, 1], of column `index` along `along` that lies in [low, high).
double share_within(const ColumnLattice& lattice, std::size_t along, std::int32_t index, std::int32_t low, std::int32_t high) {
  const std::int32_t first = lattice.line(along, index), end = lattice.line(along, index + 1);
  return static_cast<double>(std::min(end, high) - std::max(first, low)) / static_cast<double>(end - first);
}

/// The load of the part of column `index` along `along` that lies in the rectangle, summed across the other axis.
double strip_load(const ColumnLoads& loads, const Rectangle& in, std::size_t along, std::int32_t index) {
  const ColumnLattice& lattice = loads.lattice;
  const std::size_t across = 1 - along;
  double sum = 0;
  for (std::int32_t i = lattice.column_at(across, in.low[across]); i <= lattice.column_at(across, in.high[across] - 1); ++i) {
    const std::uint64_t load = loads.load[along == 0 ? lattice.number(index, i) : lattice.number(i, index)];
    sum += static_cast<double>(load) * share_within(lattice, across, i, in.low[across], in.high[across]);
  }
  return sum * share_within(lattice, along, index, in.low[along], in.high[along]);
}

/// The cuts that leave each side at least `columns_each` finest columns a region: [least, most] along one axis.
struct CutRange {
  std::int32_t least, most;
};

std::optional<CutRange> cuts_allowed(const Rectangle& box, std::size_t along, std::uint32_t low_count, std::uint32_t high_count,
                                     std::int64_t columns_each) {
  const std::int64_t across = box.length(1 - along);
  const auto least = box.low[along] + core::ceil_divide(columns_each * low_count, across);
  const auto most = box.high[along] - core::ceil_divide(columns_each * high_count, across);
  if (least > most) {
    return std::nullopt;
  }
  return CutRange{static_cast<std::int32_t>(least), static_cast<std::int32_t>(most)};
}

Rectangle rectangle_of(const core::Region& region, const CutAxes& axes) {
  return {{region.low[axes[0]], region.low[axes[1]]}, {region.high[axes[0]], region.high[axes[1]]}};
}

}  // namespace

std::uint32_t Bsp::region_index_of(const core::Corner& cell) const {
  std::uint32_t first = 0, count = region_count_;
  while (count > 1) {
    const std::uint32_t low_count = low_count_of(count);
    const Cut cut = cuts_[first + low_count - 1];
    const bool is_low = cell[cut.axis()] < cut.at();
    first += is_low ? 0 : low_count;
    count = is_low ? low_count : count - low_count;
  }
  return first;
}

FoundRegion Bsp::find(const core::Corner& cell) const {
  FoundRegion found{0, {{}, grid_size_}};
  for (std::uint32_t count = region_count_; count > 1;) {
    const std::uint32_t low_count = low_count_of(count);
    const Cut cut = cuts_[found.index + low_count - 1];
    const bool is_low = cell[cut.axis()] < cut.at();
    (is_low ? found.box.high : found.box.low)[cut.axis()] = cut.at();
    found.index += is_low ? 0 : low_count;
    count = is_low ? low_count : count - low_count;
  }
  return found;
}

core::Region Bsp::region_at(std::uint32_t index) const {
  core::Region region{{}, grid_size_};
  for_each_cut(index, [&](Cut cut, bool is_high) { (is_high ? region.low : region.high)[cut.axis()] = cut.at(); });
  return region;
}

Bsp::Leaf Bsp::leaf_around(std::uint32_t index) const {
  Leaf leaf{{{}, grid_size_}, 0, region_count_};
  while (!owns(owner_at(index), leaf)) {
    const std::uint32_t low_count = low_count_of(leaf.count);
    const Cut& cut = cuts_[leaf.first + low_count - 1];
    const bool is_high = index >= leaf.first + low_count;
    (is_high ? leaf.box.low : leaf.box.high)[cut.axis()] = cut.at();
    leaf.first += is_high ? low_count : 0;
    leaf.count = is_high ? leaf.count - low_count : low_count;
  }
  return leaf;
}

bool Bsp::owns(nodes::NodeId node, const Leaf& leaf) const {
  const auto first = owner_.begin() + leaf.first;
  return std::all_of(first, first + leaf.count, [node](std::uint16_t owner) { return owner == nodes::index_of(node); });
}

std::uint32_t Bsp::region_index_of(nodes::NodeId node) const {
  const auto end = owner_.begin() + region_count_;
  const auto found = std::find(owner_.begin(), end, nodes::index_of(node));
  core::expect(found != end, "a node that is asked for its region owns one");
  return static_cast<std::uint32_t>(found - owner_.begin());
}

void Bsp::assign(std::span<const std::uint32_t> node_of_region) {
  const std::uint32_t each = units_each_;
  core::expect(node_of_region.size() == node_count_, "every node's regions are given to a node");
  std::vector<bool> taken(node_count_, false);
  for (std::uint32_t region = 0; region < region_count_; ++region) {
    const std::uint32_t node = node_of_region[region / each];
    core::expect(node < node_count_ && (region % each > 0 || !taken[node]), "every node owns as many regions");
    taken[node] = true;
    owner_[region] = static_cast<std::uint16_t>(node);
  }
}

Bsp Bsp::without_units() const {
  Bsp whole(grid_size_);
  whole.region_count_ = whole.node_count_ = node_count_;
  for (std::uint32_t node = 0; node < node_count_; ++node) {
    whole.owner_[node] = static_cast<std::uint16_t>(node);
    if (node + 1 < node_count_) {
      whole.cuts_[node] = cuts_[(node + 1) * units_each_ - 1];
    }
  }
  return whole;
}

Bsp Bsp::by_unit() const {
  Bsp units = *this;
  units.node_count_ = region_count_;
  std::vector<bool> is_used(node_count_, false);
  for (std::uint32_t unit = 0; unit < region_count_; ++unit) {
    is_used[owner_[unit]] = is_used[owner_[unit]] || !is_empty(unit);
  }
  units.empty_ = {};
  for (std::uint32_t unit = 0; unit < region_count_; ++unit) {
    units.owner_[unit] = static_cast<std::uint16_t>(unit);
    if (!is_used[owner_[unit]]) {
      units.mark_empty(unit);
    }
  }
  return units;
}

/// Cuts boxes recursively; the larger share of the regions is always on the high side.
class BspBuilder {
 public:
  /// `loads` are those of the lattice's columns; null if there are none.
  BspBuilder(const ColumnLattice& lattice, const ColumnLoads* loads, std::uint32_t region_count, const BspOptions& options,
             std::uint32_t units_a_node = 1)
      : lattice_(lattice), options_(options), bsp_(lattice.grid_size()) {
    bsp_.region_count_ = region_count;
    bsp_.node_count_ = region_count / units_a_node;
    bsp_.units_each_ = units_a_node;
    for (std::uint32_t region = 0; region < bsp_.owner_.size(); ++region) {
      bsp_.owner_[region] = static_cast<std::uint16_t>(region / units_a_node);
    }
    for (std::size_t along = 0; along < 2; ++along) {
      for (std::int32_t i = 0; i <= lattice.count(along); ++i) {
        lines_[along].push_back(lattice.line(along, i));
      }
    }
    const double total = loads == nullptr ? 0.0 : sum_of(*loads);
    if (total > 0) {
      loads_ = loads;
      area_weight_ = area_share * total / static_cast<double>(std::int64_t{lattice.size(0)} * lattice.size(1));
    }
  }

  Bsp build() {
    cut({{0, 0}, {lattice_.size(0), lattice_.size(1)}}, 0, bsp_.region_count_, 0);
    return bsp_;
  }

 private:
  struct Place {
    std::size_t along;
    std::int32_t at;
  };

  static double sum_of(const ColumnLoads& loads) {
    return std::accumulate(loads.load.begin(), loads.load.end(), 0.0,
                           [](double sum, std::uint64_t load) { return sum + static_cast<double>(load); });
  }

  /// The beginning of column `index`.
  std::int32_t line(std::size_t along, std::int32_t index) const { return lines_[along][static_cast<std::size_t>(index)]; }

  void cut(const Rectangle& box, std::uint32_t first, std::uint32_t count, std::size_t depth) {
    if (count == 1) {
      return;
    }
    const std::uint32_t low_count = bsp_.low_count_of(count);
    const std::uint32_t together = count > bsp_.units_each_ ? bsp_.units_each_ : 1;  // as if each node had one region
    const Place place = choose(box, low_count / together, (count - low_count) / together, depth);
    bsp_.cuts_[first + low_count - 1] = {place.at, lattice_.axes()[place.along]};
    Rectangle low = box, high = box;
    low.high[place.along] = high.low[place.along] = place.at;
    cut(low, first, low_count, depth + 1);
    cut(high, first + low_count, count - low_count, depth + 1);
  }

  /// The preferred axis if it has a cut that leaves each region some columns; else the other axis, if necessary with fewer
  /// columns.
  Place choose(const Rectangle& box, std::uint32_t low_count, std::uint32_t high_count, std::size_t depth) const {
    const std::size_t preferred = preferred_axis(box, depth);
    for (const std::int64_t columns_each : {4, 2, 1}) {
      for (const std::size_t along : {preferred, 1 - preferred}) {
        if (box.area() > 0) {
          if (const auto range = cuts_allowed(box, along, low_count, high_count, columns_each)) {
            return {along, median(box, along, low_count, high_count, *range)};
          }
        }
      }
    }
    // More regions than columns: cuts in the middle; some regions will be empty.
    return {preferred, box.low[preferred] + box.length(preferred) / 2};
  }

  std::size_t preferred_axis(const Rectangle& box, std::size_t depth) const {
    if (options_.order == CutOrder::alternating) {
      return depth % 2;
    }
    return box.length(0) > box.length(1) ? 0 : 1;
  }

  double strip(const Rectangle& box, std::size_t along, std::int32_t index) const {
    const std::int32_t low = std::max(box.low[along], line(along, index));
    const std::int32_t high = std::min(box.high[along], line(along, index + 1));
    const double load = loads_ == nullptr ? 0.0 : strip_load(*loads_, box, along, index);
    return load + area_weight_ * static_cast<double>(high - low) * box.length(1 - along);
  }

  /// The position where the low side has its share of the box's load, as nearly as the range allows.
  std::int32_t median(const Rectangle& box, std::size_t along, std::uint32_t low_count, std::uint32_t high_count,
                      const CutRange& range) const {
    const std::int32_t first = lattice_.column_at(along, box.low[along]);
    const std::int32_t last = lattice_.column_at(along, box.high[along] - 1);
    std::vector<double> strips;
    strips.reserve(static_cast<std::size_t>(last - first) + 1);
    for (std::int32_t i = first; i <= last; ++i) {
      strips.push_back(strip(box, along, i));
    }
    const double region_load = std::accumulate(strips.begin(), strips.end(), 0.0) / (low_count + high_count);
    double missing = region_load * low_count;
    std::int32_t column = first;
    while (column < last && strips[static_cast<std::size_t>(column - first)] <= missing) {
      missing -= strips[static_cast<std::size_t>(column - first)];
      ++column;
    }
    const double inside = strips[static_cast<std::size_t>(column - first)];
    return std::clamp(place_in_column(box, along, column, missing, inside, region_load), range.least, range.most);
  }

  /// The nearer of the column's two lines, or a position inside if that misses the share by too much. `missing` of the column's
  /// load `inside` the box belongs to the low side.
  std::int32_t place_in_column(const Rectangle& box, std::size_t along, std::int32_t column, double missing, double inside,
                               double region_load) const {
    const std::int32_t low = std::max(box.low[along], line(along, column));
    const std::int32_t high = std::min(box.high[along], line(along, column + 1));
    const double share = std::clamp(missing / inside, 0.0, 1.0);
    if (std::min(share, 1.0 - share) * inside > options_.hot_spot_share * region_load) {
      return low + static_cast<std::int32_t>(std::floor(share * (high - low) + 0.5));
    }
    return share < 0.5 ? low : high;
  }

  const ColumnLattice& lattice_;
  std::array<std::vector<std::int32_t>, 2> lines_;  ///< the lattice's
  const ColumnLoads* loads_ = nullptr;              ///< null: there are none
  BspOptions options_;
  Bsp bsp_;
  double area_weight_ = 1;
};

namespace {

void check_region_count(std::uint32_t region_count) {
  if (region_count < 1 || region_count > region_count_max) {
    throw core::UsageError("space can be cut into 1 to " + std::to_string(region_count_max) + " regions, not " +
                           std::to_string(region_count));
  }
}

}  // namespace

Bsp build_bsp(const ColumnLoads& loads, std::uint32_t region_count, const BspOptions& options) {
  check_region_count(region_count);
  return BspBuilder(loads.lattice, &loads, region_count, options).build();
}

Bsp build_units(const ColumnLoads& loads, std::uint32_t node_count, std::uint32_t units_a_node, const BspOptions& options) {
  core::expect(units_a_node >= 1, "a node has a unit or more");
  check_region_count(node_count);
  if (std::uint64_t{node_count} * units_a_node > region_count_max) {
    throw core::UsageError("space can be cut into at most " + std::to_string(region_count_max) + " units, not into " +
                           std::to_string(units_a_node) + " for each of " + std::to_string(node_count) +
                           " nodes: ask for fewer of either");
  }
  return BspBuilder(loads.lattice, &loads, node_count * units_a_node, options, units_a_node).build();
}

Bsp equal_size_bsp(const core::Corner& grid_size, const CutAxes& axes, std::uint32_t region_count, const BspOptions& options) {
  check_region_count(region_count);
  const std::int32_t longest = std::max(grid_size[axes[0]], grid_size[axes[1]]);
  constexpr std::int32_t columns_max = 1024;
  const ColumnLattice lattice(grid_size, axes, std::min(longest, columns_max));
  return BspBuilder(lattice, nullptr, region_count, options).build();
}

std::vector<double> loads_of_regions(const Bsp& bsp, const ColumnLoads& loads) {
  std::vector<double> sums;
  for (std::uint32_t region = 0; region < bsp.region_count(); ++region) {
    const Rectangle box = rectangle_of(bsp.region_at(region), loads.lattice.axes());
    double sum = 0;
    if (box.area() > 0) {
      for (std::int32_t i = loads.lattice.column_at(0, box.low[0]); i <= loads.lattice.column_at(0, box.high[0] - 1); ++i) {
        sum += strip_load(loads, box, 0, i);
      }
    }
    sums.push_back(sum);
  }
  return sums;
}

double average_load(std::span<const double> loads) {
  const double most = loads.empty() ? 0 : *std::max_element(loads.begin(), loads.end());
  return most > 0 ? std::accumulate(loads.begin(), loads.end(), 0.0) / (most * static_cast<double>(loads.size())) : 1.0;
}

namespace {

/// One side of a region's rectangle, on a line across an axis.
struct Side {
  std::int32_t at, low, high;  ///< the line, and the extent along it
  std::uint32_t region;
};

/// Adds the boundaries on lines at one place `along` an axis: `ends` are regions' upper sides there, `begins` lower ones, both
/// ascending by place and extent.
void add_boundaries(const std::vector<Side>& ends, const std::vector<Side>& begins, std::vector<Boundary>& found) {
  auto same_line = begins.begin();
  for (const Side& end : ends) {
    same_line = std::find_if(same_line, begins.end(), [&](const Side& begin) { return begin.at >= end.at; });
    for (auto begin = same_line; begin != begins.end() && begin->at == end.at && begin->low < end.high; ++begin) {
      const std::int32_t length = std::min(end.high, begin->high) - std::max(end.low, begin->low);
      if (length > 0 && begin->region != end.region) {
        found.push_back({std::min(begin->region, end.region), std::max(begin->region, end.region), length});
      }
    }
  }
}

}  // namespace

std::vector<Boundary> boundaries_of(const Bsp& bsp, const CutAxes& axes) {
  const auto before = [](const Side& a, const Side& b) { return std::tie(a.at, a.low) < std::tie(b.at, b.low); };
  std::vector<Boundary> found;
  for (std::size_t along = 0; along < 2; ++along) {
    std::vector<Side> ends, begins;
    for (std::uint32_t region = 0; region < bsp.region_count(); ++region) {
      const Rectangle box = rectangle_of(bsp.region_at(region), axes);
      ends.push_back({box.high[1 - along], box.low[along], box.high[along], region});
      begins.push_back({box.low[1 - along], box.low[along], box.high[along], region});
    }
    std::sort(ends.begin(), ends.end(), before);
    std::sort(begins.begin(), begins.end(), before);
    add_boundaries(ends, begins, found);
  }
  std::sort(found.begin(), found.end(),
            [](const Boundary& a, const Boundary& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace dmpc::dataflow
