// The columns of the scene: a 2D lattice over two of the grid's axes, and the work of rays in each of its cells.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/expect.h"
#include "core/base/region.h"

namespace dmpc::dataflow {

/// The region of a finest cell: its number, and its box in finest cells.
struct FoundRegion {
  std::uint32_t index = 0;
  core::Region box;
};

/// The two grid axes to which the cuts are perpendicular; along the third every region spans the grid. Different, below 3.
using CutAxes = std::array<std::uint8_t, 2>;

/// Lattice lines at finest indices, as evenly as integers allow, over the grid's extent in the two cut axes. "Along 0" and "along
/// 1" are the first and second of the cut axes. An immutable value.
class ColumnLattice {
 public:
  /// `grid_size` in finest cells. At most `cells_per_side` columns along each cut axis, and at most one per finest cell. Requires
  /// sizes above 0.
  ColumnLattice(const core::Corner& grid_size, const CutAxes& axes, std::int32_t cells_per_side)
      : grid_size_(grid_size), axes_(axes) {
    core::expect(axes[0] < 3 && axes[1] < 3 && axes[0] != axes[1], "the cuts are perpendicular to two different axes");
    core::expect(*std::min_element(grid_size.begin(), grid_size.end()) > 0 && cells_per_side > 0, "a lattice has columns");
    count_ = {std::min(cells_per_side, size(0)), std::min(cells_per_side, size(1))};
  }

  const core::Corner& grid_size() const { return grid_size_; }
  const CutAxes& axes() const { return axes_; }
  /// The grid's extent along cut axis `along`, in finest cells.
  std::int32_t size(std::size_t along) const { return grid_size_[axes_[along]]; }
  /// Columns along cut axis `along`.
  std::int32_t count(std::size_t along) const { return count_[along]; }
  std::size_t column_count() const { return static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]); }

  /// The finest index at which column `index` starts; line(count) is the grid's size.
  std::int32_t line(std::size_t along, std::int32_t index) const {
    return static_cast<std::int32_t>(std::int64_t{index} * size(along) / count_[along]);
  }
  /// The column that holds the finest index, which lies in the grid.
  std::int32_t column_at(std::size_t along, std::int32_t finest) const {
    return static_cast<std::int32_t>(((std::int64_t{finest} + 1) * count_[along] - 1) / size(along));
  }
  /// The number of the column that holds the finest cell.
  std::size_t column_of(const core::Corner& cell) const {
    return number(column_at(0, cell[axes_[0]]), column_at(1, cell[axes_[1]]));
  }
  /// The number of the column at (along 0, along 1): neighbours along 0 are consecutive.
  std::size_t number(std::int32_t at0, std::int32_t at1) const {
    return static_cast<std::size_t>(at1) * static_cast<std::size_t>(count_[0]) + static_cast<std::size_t>(at0);
  }

 private:
  core::Corner grid_size_;
  CutAxes axes_;
  std::array<std::int32_t, 2> count_{};
};

/// The work of every column, in any unit: integers, so that a sum does not depend on the order.
struct ColumnLoads {
  ColumnLattice lattice;
  std::vector<std::uint64_t> load;  ///< by column number

  /// No load anywhere: the loads of equal-size regions.
  explicit ColumnLoads(const ColumnLattice& over) : lattice(over), load(over.column_count()) {}
};

}  // namespace dmpc::dataflow
