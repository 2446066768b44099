// The order of entries in the directory: row by row, x fastest, for voxels z fastest; and the lists of voxels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/base/units.h"
#include "core/record/record.h"
#include "core/record/records.h"

namespace dmpc::core {

/// The number of entries of a directory of `size` macro cells along x, y, z; two share a record.
constexpr std::uint64_t directory_entry_count(const std::array<std::int32_t, 3>& size) {
  return round_up(static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]) * static_cast<std::uint64_t>(size[2]),
                  std::uint64_t{2});
}

/// The number of the entry of the macro cell that holds the finest cell `cell`, counted from the directory's corner; not
/// negative.
constexpr std::uint64_t directory_index(const std::array<std::int32_t, 3>& size, const Corner& cell) {
  const auto top = [&](std::size_t axis) { return static_cast<std::uint32_t>(cell[axis]) / finest_per_macro; };
  const auto length = [&](std::size_t axis) { return static_cast<std::uint32_t>(size[axis]); };
  return top(0) + std::uint64_t{length(0)} * (top(1) + std::uint64_t{length(1)} * top(2));
}

/// directory_index() with z fastest, after the article.
constexpr std::uint64_t voxel_index(const std::array<std::int32_t, 3>& size, const Corner& cell) {
  return directory_index({size[2], size[1], size[0]}, {cell[2], cell[1], cell[0]});
}

/// The finest cell with edges of 2^doublings finest cells that holds `cell`.
constexpr Corner doubled(const Corner& cell, std::int32_t doublings) {
  return {cell[0] >> doublings, cell[1] >> doublings, cell[2] >> doublings};
}

/// The index in the directory of `header`, for a cell of the grid.
constexpr std::uint64_t directory_index(const DatabaseHeader& header, const Corner& cell) {
  const Corner& low = header.directory_low;
  const Corner place{cell[0] - low[0], cell[1] - low[1], cell[2] - low[2]};
  return header.has_voxels() ? voxel_index(header.directory_size, place) : directory_index(header.directory_size, place);
}

/// The record that holds entry `index`: two entries, since addresses count in 8 bytes.
constexpr Address directory_address(const DatabaseHeader& header, std::uint64_t index) {
  return advance(header.directory, index / 2 * record_alignment);
}

/// Where entry `index` begins in its record.
constexpr std::size_t directory_offset(std::uint64_t index) { return index % 2 * sizeof(DirectoryEntry); }

/// The entry of a cell of the grid; find(address) is the record at an address.
template <class Find>
DirectoryEntry entry_of(const DatabaseHeader& header, const Corner& cell, const Find& find) {
  const std::uint64_t index = directory_index(header, cell);
  return read<DirectoryEntry>(find(directory_address(header, index)) + directory_offset(index));
}

/// Calls visit(cell) for the lower corners of the macro cells from one, `low`, to before `high`: x fastest, or z.
template <class Visit>
void for_each_macro_cell(const Corner& low, const Corner& high, bool z_fastest, const Visit& visit) {
  const std::size_t slow = z_fastest ? 0 : 2, fast = 2 - slow;
  Corner cell;
  for (cell[slow] = low[slow]; cell[slow] < high[slow]; cell[slow] += finest_per_macro) {
    for (cell[1] = low[1]; cell[1] < high[1]; cell[1] += finest_per_macro) {
      for (cell[fast] = low[fast]; cell[fast] < high[fast]; cell[fast] += finest_per_macro) {
        visit(std::as_const(cell));
      }
    }
  }
}

/// Likewise, of references of voxels.
constexpr Address reference_address(const DatabaseHeader& header, std::uint64_t index) {
  return advance(header.references, index / 2 * record_alignment);
}
constexpr std::size_t reference_offset(std::uint64_t index) { return index % 2 * sizeof(VoxelReference); }

/// Calls visit(leaf's address) for the list of an occupied voxel, whose records are present. Requires header.has_voxels().
template <Records R, class Visit>
void for_each_listed(R& records, const DatabaseHeader& header, const DirectoryEntry& voxel, const Visit& visit) {
  for (std::uint64_t index = voxel.bits;; ++index) {
    const auto reference = read<VoxelReference>(records.find(reference_address(header, index)) + reference_offset(index));
    visit(reference.leaf());
    if (reference.is_last()) {
      return;
    }
  }
}

}  // namespace dmpc::core
