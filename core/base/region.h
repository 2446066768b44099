// A box of finest cells: the part of space that a node owns.
#pragma once

#include <array>
#include <cstdint>

namespace dmpc::core {

/// A cell's lower corner, in finest cells of the grid.
using Corner = std::array<std::int32_t, 3>;

/// Half-open: low <= cell < high along every axis.
struct Region {
  Corner low{}, high{};

  constexpr bool contains(const Corner& cell) const {
    return cell[0] >= low[0] && cell[0] < high[0] && cell[1] >= low[1] && cell[1] < high[1] && cell[2] >= low[2] &&
           cell[2] < high[2];
  }
  /// Whether the whole cube of edge `span` at `cell` lies in the region.
  constexpr bool contains(const Corner& cell, std::int32_t span) const {
    return contains(cell) && contains({cell[0] + span - 1, cell[1] + span - 1, cell[2] + span - 1});
  }
  constexpr bool overlaps(const Corner& cell, std::int32_t span) const {
    return cell[0] < high[0] && cell[0] + span > low[0] && cell[1] < high[1] && cell[1] + span > low[1] && cell[2] < high[2] &&
           cell[2] + span > low[2];
  }
  constexpr bool operator==(const Region&) const = default;
};

}  // namespace dmpc::core
