#include "dataflow/regions/scattered.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "nodes/topology.h"

namespace dmpc::dataflow {
namespace {

/// The number of cells of the lattice along both axes.
using Extent = std::array<std::uint32_t, 2>;

std::vector<Extent> factor_pairs(std::uint32_t product) {
  std::vector<Extent> pairs;
  for (std::uint32_t first = 1; first <= product; ++first) {
    if (product % first == 0) {
      pairs.push_back({first, product / first});
    }
  }
  return pairs;
}

/// A window that contains each node once, and the number of windows in the lattice along both axes.
struct Tiling {
  Extent window, windows;

  Extent count() const { return {window[0] * windows[0], window[1] * windows[1]}; }
};

/// The ratio of the longer to the shorter side of a rectangle: 1 for a square.
double stretch(double width, double height) { return std::max(width / height, height / width); }

/// The same ratio for the cells of a lattice.
double stretch(const std::array<std::int32_t, 2>& size, const Extent& count) {
  return stretch(static_cast<double>(size[0]) / count[0], static_cast<double>(size[1]) / count[1]);
}

std::optional<Tiling> squarest(const std::array<std::int32_t, 2>& size, std::uint32_t node_count, std::uint32_t regions_a_node) {
  constexpr double as_good = 1e-9;
  std::optional<Tiling> best;
  for (const Extent& window : factor_pairs(node_count)) {
    for (const Extent& windows : factor_pairs(regions_a_node)) {
      const Tiling tiling{window, windows};
      const Extent count = tiling.count();
      if (count[0] > static_cast<std::uint32_t>(size[0]) || count[1] > static_cast<std::uint32_t>(size[1])) {
        continue;
      }
      const double more = best ? stretch(size, count) - stretch(size, best->count()) : -1.0;
      if (more < -as_good ||
          (more < as_good && stretch(window[0], window[1]) < stretch(best->window[0], best->window[1]) - as_good)) {
        best = tiling;
      }
    }
  }
  return best;
}

/// The square of the least distance between two regions of one node, if regions (x, y) with x + step y divisible by `node_count`
/// belong to one node.
std::uint64_t nearest_own(std::uint64_t step, std::uint64_t node_count) {
  std::uint64_t nearest = node_count * node_count;  // (node_count, 0)
  for (std::uint64_t y = 1; y * y < nearest; ++y) {
    const std::uint64_t rest = step * y % node_count, x = std::min(rest, node_count - rest);
    nearest = std::min(nearest, x * x + y * y);
  }
  return nearest;
}

/// The step along the other axis, where the step along the longer side of the window is 1: any step if the window is one row,
/// else one that maps rows to different multiples of the row's length.
std::uint32_t choose_step(std::uint32_t row, std::uint32_t rows) {
  const std::uint32_t node_count = row * rows, unit = rows == 1 ? 1 : row;
  std::uint32_t best = 0;
  std::uint64_t farthest = 0;
  for (std::uint32_t step = unit; step < node_count; step += unit) {
    const bool is_even = rows == 1 || std::gcd(step / row, rows) == 1;
    const std::uint64_t distance = is_even ? nearest_own(step, node_count) : 0;
    if (distance > farthest) {
      best = step;
      farthest = distance;
    }
  }
  return best;
}

/// The number of nodes that are adjacent on the torus to the node `step` further on.
std::uint32_t adjacent_count(const nodes::Topology& torus, std::uint32_t step) {
  std::uint32_t count = 0;
  for (std::uint32_t node = 0; node < torus.node_count(); ++node) {
    count += torus.hops(nodes::NodeId{node}, nodes::NodeId{(node + step) % torus.node_count()}) <= 1 ? 1 : 0;
  }
  return count;
}

/// A number coprime to node_count by which both steps are multiplied: regions that share a node still do.
std::uint32_t choose_factor(std::uint32_t step, std::uint32_t node_count) {
  const nodes::Topology torus(nodes::TopologyKind::torus, node_count);
  std::uint32_t best = 1, fewest = std::numeric_limits<std::uint32_t>::max();
  for (std::uint32_t factor = 1; factor < node_count && fewest > 0; ++factor) {
    if (std::gcd(factor, node_count) != 1) {
      continue;
    }
    const auto other = static_cast<std::uint32_t>(std::uint64_t{factor} * step % node_count);
    const std::uint32_t adjacent = adjacent_count(torus, factor) + adjacent_count(torus, other);
    if (adjacent < fewest) {
      best = factor;
      fewest = adjacent;
    }
  }
  return best;
}

}  // namespace

std::optional<ScatteredShape> scattered_shape(const std::array<std::int32_t, 2>& size, std::uint32_t node_count,
                                              std::uint32_t regions_a_node) {
  const std::optional<Tiling> tiling = squarest(size, node_count, regions_a_node);
  if (!tiling) {
    return std::nullopt;
  }
  ScatteredShape shape{.count = tiling->count()};
  if (node_count > 1) {
    const std::size_t along = tiling->window[0] > 1 ? 0 : 1;
    const std::uint32_t step = choose_step(tiling->window[along], tiling->window[1 - along]);
    const std::uint32_t factor = choose_factor(step, node_count);
    shape.step[along] = factor;
    shape.step[1 - along] = static_cast<std::uint32_t>(std::uint64_t{factor} * step % node_count);
  }
  return shape;
}

core::Region Scattered::region_at(std::uint32_t index) const {
  core::expect(index < region_count(), "a region has a number below the count");
  core::Region region{{}, grid_size_};
  const Extent at = {index % shape_.count[0], index / shape_.count[0]};
  for (std::size_t along = 0; along < 2; ++along) {
    region.low[axes_[along]] = line(along, at[along]);
    region.high[axes_[along]] = line(along, at[along] + 1);
  }
  return region;
}

Scattered scatter(const core::Corner& grid_size, const CutAxes& axes, std::uint32_t node_count, std::uint32_t regions_a_node) {
  const std::string sentence =
      std::to_string(regions_a_node) + " regions a node on " + std::to_string(node_count) + " nodes are too many: ";
  if (std::uint64_t{regions_a_node} * node_count > Scattered::regions_max) {
    throw core::UsageError(sentence + "all nodes together can have " + std::to_string(Scattered::regions_max) +
                           " regions, so each of these " + std::to_string(Scattered::regions_max / node_count));
  }
  const std::array<std::int32_t, 2> size = {grid_size[axes[0]], grid_size[axes[1]]};
  const std::optional<ScatteredShape> shape = scattered_shape(size, node_count, regions_a_node);
  if (!shape) {
    throw core::UsageError(sentence + "the grid has " + std::to_string(size[0]) + "x" + std::to_string(size[1]) +
                           " finest columns, and each region needs one");
  }
  return {grid_size, axes, node_count, *shape};
}

}  // namespace dmpc::dataflow
