// Several partitions of one grid overlaid: the cells between all their cuts, and the owner of each in every partition.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/region.h"
#include "dataflow/regions/regions.h"

namespace dmpc::dataflow {

/// A lattice for finding a ray's way through the regions of all partitions at once (LatticeTraversal). Immutable.
class JointLattice {
 public:
  static constexpr std::size_t partitions_max = 64;

  /// Requires 1 to partitions_max partitions of one grid.
  explicit JointLattice(std::span<const Regions> partitions);
  /// Its size: an owner for each partition in each cell.
  static std::size_t owner_count(std::span<const Regions> partitions);

  /// A bit for each partition.
  std::uint64_t all_partitions() const { return ~std::uint64_t{0} >> (partitions_max - partition_count_); }
  /// The planes between cells along an axis, in finest cells, ascending: the cuts, between the grid's two ends.
  std::span<const std::int32_t> planes(std::size_t axis) const { return planes_[axis]; }

  /// A cell by its index along each axis: between planes i and i + 1.
  using Place = std::array<std::size_t, 3>;
  std::size_t cell_at(const Place& place) const { return place[0] * stride_[0] + place[1] * stride_[1] + place[2] * stride_[2]; }
  /// From a cell to the next along an axis.
  std::size_t stride(std::size_t axis) const { return stride_[axis]; }
  /// The node that owns the cell, by partition.
  std::span<const std::uint16_t> owners(std::size_t cell) const {
    return std::span(owners_).subspan(cell * partition_count_, partition_count_);
  }
  /// The partitions whose region there is not known to be empty, a bit each.
  std::uint64_t occupied(std::size_t cell) const { return occupied_[cell]; }

 private:
  void add_cell(std::span<const Regions> partitions, const Place& place);

  std::size_t partition_count_;
  std::array<std::vector<std::int32_t>, 3> planes_;
  Place stride_{};
  std::vector<std::uint16_t> owners_;
  std::vector<std::uint64_t> occupied_;
};

}  // namespace dmpc::dataflow
