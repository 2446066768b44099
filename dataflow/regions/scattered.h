// A regular lattice of many regions, assigned to the nodes so that each has as many, far from each other.
//
// Source of the idea: H. Kobayashi and others, 1988, as described by D. Badouel, K. Bouatouch, T. Priol, "Distributing Data and
// Control for Ray Tracing in Parallel", 1994: load concentrates locally, so it is split into several regions, and neighbours go
// to processors that are not adjacent on a 2D torus, by a mapping function. The function here is our own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "core/base/expect.h"
#include "core/base/region.h"
#include "dataflow/regions/columns.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// The number of regions of a lattice along the two cut axes, and their assignment: the region at (x, y) belongs to node (step[0]
/// x + step[1] y) mod node_count.
struct ScatteredShape {
  std::array<std::uint32_t, 2> count = {1, 1};
  std::array<std::uint32_t, 2> step = {0, 0};
  constexpr bool operator==(const ScatteredShape&) const = default;
};

/// The shape of a lattice over this number of finest cells along the two cut axes, with cells as near to squares as possible;
/// nothing if no lattice of `regions_a_node` times `node_count` regions has a finest cell for each row and column.
///
/// Every node has exactly regions_a_node regions, since each window of p q = node_count cells has each node once. With more than
/// one, neighbours along either axis belong to different nodes; among the steps that achieve this the first is chosen that keeps
/// one node's regions farthest apart, and then puts the fewest neighbours on nodes that are adjacent on a torus
/// (nodes/topology.h): none on 64, 100 or 128 nodes, some on 16 or 36.
std::optional<ScatteredShape> scattered_shape(const std::array<std::int32_t, 2>& size, std::uint32_t node_count,
                                              std::uint32_t regions_a_node);

/// The regions of a run and their owners, by arithmetic. Regions are numbered row by row, along the first cut axis. Immutable
/// except for mark_empty(); as plain bytes copyable to every node.
class Scattered {
 public:
  /// The maximum number of regions of all nodes together.
  static constexpr std::uint32_t regions_max = 65536;

  /// Requires a shape of scattered_shape() for the grid's extent along `axes`, with at most regions_max regions.
  Scattered(const core::Corner& grid_size, const CutAxes& axes, std::uint32_t node_count, const ScatteredShape& shape)
      : grid_size_(grid_size), axes_(axes), node_count_(node_count), shape_(shape) {
    core::expect(region_count() >= 1 && region_count() <= regions_max, "a lattice has from 1 to 65536 regions");
  }

  std::uint32_t node_count() const { return node_count_; }
  std::uint32_t region_count() const { return shape_.count[0] * shape_.count[1]; }
  const core::Corner& grid_size() const { return grid_size_; }
  const CutAxes& axes() const { return axes_; }
  const ScatteredShape& shape() const { return shape_; }

  /// The region of a finest cell of the grid.
  std::uint32_t region_index_of(const core::Corner& cell) const {
    return column_at(1, cell) * shape_.count[0] + column_at(0, cell);
  }
  /// The region with its box.
  FoundRegion find(const core::Corner& cell) const {
    const std::uint32_t index = region_index_of(cell);
    return {index, region_at(index)};
  }
  /// The box of region `index`, in finest cells.
  core::Region region_at(std::uint32_t index) const;
  /// The first finest cell of row or column `at` of the lattice, along cut axis `along`; one past the last is the grid's end.
  std::int32_t line(std::size_t along, std::uint32_t at) const {
    return static_cast<std::int32_t>(std::int64_t{at} * grid_size_[axes_[along]] / shape_.count[along]);
  }
  /// The owner of region `index`.
  nodes::NodeId owner_at(std::uint32_t index) const {
    const std::uint64_t x = index % shape_.count[0], y = index / shape_.count[0];
    return nodes::NodeId{static_cast<std::uint32_t>((shape_.step[0] * x + shape_.step[1] * y) % node_count_)};
  }

  bool is_empty(std::uint32_t index) const { return (empty_[index / 64] >> (index % 64) & 1U) != 0; }
  void mark_empty(std::uint32_t index) { empty_[index / 64] |= std::uint64_t{1} << (index % 64); }

 private:
  std::uint32_t column_at(std::size_t along, const core::Corner& cell) const {
    const std::int64_t finest = cell[axes_[along]];
    return static_cast<std::uint32_t>(((finest + 1) * shape_.count[along] - 1) / grid_size_[axes_[along]]);
  }

  core::Corner grid_size_;
  CutAxes axes_;
  std::uint32_t node_count_;
  ScatteredShape shape_;
  std::array<std::uint64_t, regions_max / 64> empty_{};  ///< a bit a region
};
static_assert(std::is_trivially_copyable_v<Scattered>);

/// The lattice over a grid. Throws core::UsageError if there are more regions than regions_max or than the grid has finest cells.
Scattered scatter(const core::Corner& grid_size, const CutAxes& axes, std::uint32_t node_count, std::uint32_t regions_a_node);

}  // namespace dmpc::dataflow
