// The primitives that touch each macro cell of the grid.
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

/// Makes cells twice as large, if the frame's lists would be long.
void coarsen(GridFrame& frame);

/// A list for every occupied macro cell, the cells in Morton order; for voxels, if requested, in the order of their directory.
class MacroCells {
 public:
  /// Nothing if the lists would be long: if a primitive lies in more than four cells on average; never for a single cell. A
  /// primitive is listed in all cells within `pad`, grid-local, and perhaps a little farther off; boxes of instances in none.
  /// `excess`: excess_of() everything that is judged together with these but not listed.
  static std::optional<MacroCells> list(std::span<const PrimitiveValues> primitives, const GridFrame& frame, double pad,
                                        const Parallel& parallel, std::int64_t excess = 0);
  /// The total number of cells that primitives touch; if that is more than `most`, stops and returns `most` + 1.
  static std::uint64_t touches_of(std::span<const PrimitiveValues> primitives, const GridFrame& frame, double pad,
                                  std::uint64_t most);
  /// The `excess` of primitives that touch so many cells: by how much they exceed their share of a list; negative if they leave
  /// some of it to others.
  static std::int64_t excess_of(std::uint64_t touches, std::uint64_t count);
  /// With more touches of `count` primitives that are judged together with `listed` ones there are no lists.
  static std::uint64_t touches_max(std::uint64_t count, std::uint64_t listed);
  /// Whether everything in a box, grid-local, touches only one cell.
  static bool is_within_one(const Box& box, const GridFrame& frame, double pad);

  /// list() for a frame of voxels (core/database/structure_builders.cpp), by its rule; nothing if there are more references than
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
  /// A primitive touches a cell, given by the index of its entry in the directory.
  struct Touch {
    std::uint32_t cell, id;
  };
  /// The state of a chunk of primitives.
  struct Listed {
    std::vector<Touch> touches;
    std::size_t next = 0;     ///< the next primitive
    bool is_cut_off = false;  ///< there are more touches than were to be listed
  };
  struct Cell {
    std::uint64_t code;
    Corner corner;
    std::size_t first, count;  ///< in ids_
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
