// Which primitives touch which macro cells of the grid.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/box.h"
#include "core/database/database.h"
#include "core/database/parallel.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Makes cells twice as large, for where the lists of a frame's would be long.
void coarsen(GridFrame& frame);

/// A list for every occupied macro cell, the cells in Morton order; of voxels, if so asked for, in that of their directory.
class MacroCells {
 public:
  /// None where the lists would be long: where a primitive lies in more than four cells on average; always some for a single
  /// cell. A primitive is listed wherever it comes within `pad` of a cell, grid-local, and perhaps a little farther off; boxes
  /// of instances nowhere. `excess`: excess_of() of all that is judged together with these, and listed nowhere.
  static std::optional<MacroCells> list(std::span<const PrimitiveValues> primitives, const GridFrame& frame, double pad,
                                        const Parallel& parallel, std::int64_t excess = 0);
  /// How many cells primitives touch, added up; `most` + 1 of more than that, which ends the look at them.
  static std::uint64_t touches_of(std::span<const PrimitiveValues> primitives, const GridFrame& frame, double pad,
                                  std::uint64_t most);
  /// The `excess` of primitives that touch so many cells: how many more than their share of a list has; negative if they leave
  /// room to others.
  static std::int64_t excess_of(std::uint64_t touches, std::uint64_t count);
  /// With more touches of so many primitives that are judged together with `listed` ones there are none.
  static std::uint64_t touches_max(std::uint64_t count, std::uint64_t listed);
  /// Whether whatever lies in a box, grid-local, touches one cell alone.
  static bool is_within_one(const Box& box, const GridFrame& frame, double pad);

  /// The same for a frame of voxels (core/database/structure_builders.cpp), by its rule; none if there are more references than
  /// that allows.
  static std::optional<MacroCells> list_voxels(std::span<const PrimitiveValues> primitives, const GridFrame& frame, double pad,
                                               const VoxelRule& rule, const Parallel& parallel);

  std::size_t size() const { return cells_.size(); }
  /// The lower corner of cell `index`, in finest cells.
  const Corner& corner(std::size_t index) const { return cells_[index].corner; }
  /// The primitives of cell `index`, ascending, at least one.
  std::span<const std::uint32_t> ids(std::size_t index) const {
    return std::span(ids_).subspan(cells_[index].first, cells_[index].count);
  }
  /// The lengths of all lists.
  std::uint64_t references() const { return ids_.size(); }

 private:
  /// That a primitive touches a cell, by the index of its entry in the directory.
  struct Touch {
    std::uint32_t cell, id;
  };
  /// What is known of a chunk of primitives.
  struct Listed {
    std::vector<Touch> touches;
    std::size_t next = 0;     ///< the primitive that comes next
    bool is_cut_off = false;  ///< there are more touches than it was to list
  };
  struct Cell {
    std::uint64_t code;
    Corner corner;
    std::size_t first, count;  ///< of ids_
  };
  class Lister;
  enum class Order : std::uint8_t { morton, z_fastest };

  MacroCells(const GridFrame& frame, const std::vector<Listed>& chunks, Order order);
  static std::optional<MacroCells> list_within(const Lister& lister, std::size_t bound, std::size_t chunk_bound,
                                               const GridFrame& frame, Order order, const Parallel& parallel);

  std::vector<Cell> cells_;
  std::vector<std::uint32_t> ids_;
};

}  // namespace dmpc::core
