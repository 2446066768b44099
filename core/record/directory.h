// Where the directory keeps a top cell's entry: row by row, x fastest.
#pragma once

#include <array>

#include "core/base/units.h"
#include "core/record/record.h"

namespace dmpc::core {

/// The number of entries of a directory of `size` top cells along x, y, z; two share a record.
constexpr std::uint64_t directory_entry_count(const std::array<std::int32_t, 3>& size) {
  return round_up(static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]) * static_cast<std::uint64_t>(size[2]),
                  std::uint64_t{2});
}

/// The number of the entry of the top cell that holds the finest cell `cell`, counted from the directory's corner; not negative.
constexpr std::uint64_t directory_index(const std::array<std::int32_t, 3>& size, const Corner& cell) {
  const auto top = [&](std::size_t axis) { return static_cast<std::uint32_t>(cell[axis]) / finest_per_top; };
  const auto length = [&](std::size_t axis) { return static_cast<std::uint32_t>(size[axis]); };
  return top(0) + std::uint64_t{length(0)} * (top(1) + std::uint64_t{length(1)} * top(2));
}

/// The index in the directory of `header`, for a cell of the grid.
constexpr std::uint64_t directory_index(const DatabaseHeader& header, const Corner& cell) {
  const Corner& low = header.directory_low;
  return directory_index(header.directory_size, {cell[0] - low[0], cell[1] - low[1], cell[2] - low[2]});
}

/// The record that holds entry `index`: two entries, since addresses count in 8 bytes.
constexpr Address directory_address(const DatabaseHeader& header, std::uint64_t index) {
  return advance(header.directory, index / 2 * record_alignment);
}

/// Where entry `index` begins in its record.
constexpr std::size_t directory_offset(std::uint64_t index) { return index % 2 * sizeof(DirectoryEntry); }

}  // namespace dmpc::core
