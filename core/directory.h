// Where the directory keeps a top cell's entry: tiles of 4x4x4 entries, so that neighbours in space share a page.
#pragma once

#include <array>

#include "core/record.h"
#include "core/units.h"

namespace dmpc::core {

/// The number of entries, those that pad the last tiles included.
constexpr std::uint64_t directory_entry_count(const std::array<std::int32_t, 3>& resolution) {
  std::uint64_t count = 1;
  for (const std::int32_t cells : resolution) {
    count *= static_cast<std::uint64_t>(round_up(cells, 4));
  }
  return count;
}

/// The index of the entry of the top cell whose lower corner is `cell` (in finest cells, not negative).
constexpr std::uint64_t directory_index(const std::array<std::int32_t, 3>& resolution, const std::array<std::int32_t, 3>& cell) {
  const auto top = [&](std::size_t axis) { return static_cast<std::uint32_t>(cell[axis]) / finest_per_top; };
  const auto tiles = [&](std::size_t axis) { return (static_cast<std::uint32_t>(resolution[axis]) + 3U) / 4U; };
  const std::uint32_t x = top(0), y = top(1), z = top(2);
  const std::uint64_t tile = x / 4 + std::uint64_t{tiles(0)} * (y / 4 + std::uint64_t{tiles(1)} * (z / 4));
  return tile * 64 + x % 4 + 4 * (y % 4) + 16 * (z % 4);
}

/// The record that holds the entry: two entries share one, since addresses count in 8 bytes.
constexpr Address directory_address(const DatabaseHeader& header, const std::array<std::int32_t, 3>& cell) {
  const Corner& low = header.directory_low;
  const Corner relative{cell[0] - low[0], cell[1] - low[1], cell[2] - low[2]};
  return advance(header.directory, directory_index(header.directory_size, relative) / 2 * record_alignment);
}

/// The entry of `cell` in its record: neighbours along x alternate.
inline DirectoryEntry directory_entry(const std::byte* record, const std::array<std::int32_t, 3>& cell) {
  return read<DirectoryEntry>(record + (static_cast<std::uint32_t>(cell[0]) / finest_per_top % 2U) * sizeof(DirectoryEntry));
}

}  // namespace dmpc::core
