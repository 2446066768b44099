// How a texture's levels and tiles are counted: by those who write its records, and by those who read them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/base/units.h"
#include "core/record/record.h"

namespace dmpc::core {

/// The number of texels along a side of a level.
constexpr std::uint32_t level_size(std::uint32_t finest, std::uint32_t level) {
  return std::max<std::uint32_t>(1, finest >> level);
}

/// The number of levels of such a texture, down to a single texel.
constexpr std::uint32_t level_count(std::uint32_t width, std::uint32_t height) {
  std::uint32_t count = 1;
  while (std::max(width, height) >> count > 0) {
    ++count;
  }
  return count;
}

/// The number of tiles along a side of so many texels.
constexpr std::uint32_t tiles_along(std::uint32_t texels) { return ceil_divide(texels, tile_side); }

constexpr std::uint32_t tile_columns(const TextureReference& texture, std::uint32_t level) {
  return tiles_along(level_size(texture.width, level));
}
constexpr std::uint32_t tile_rows(const TextureReference& texture, std::uint32_t level) {
  return tiles_along(level_size(texture.height, level));
}

/// The number of tiles before a level's first; with `level` the number of levels, that of all tiles.
constexpr std::uint32_t first_tile(const TextureReference& texture, std::uint32_t level) {
  std::uint32_t count = 0;
  for (std::uint32_t finer = 0; finer < level; ++finer) {
    count += tile_columns(texture, finer) * tile_rows(texture, finer);
  }
  return count;
}
constexpr std::uint32_t tile_count(const TextureReference& texture) { return first_tile(texture, texture.level_count); }

/// The number of entries of a texture's table: an even one, since two share a record.
constexpr std::size_t tile_entry_count(const TextureReference& texture) {
  return round_up(std::size_t{tile_count(texture)}, std::size_t{2});
}
/// The record that holds the entry of a tile, and where in it that begins.
constexpr Address tile_entry_address(const TextureReference& texture, std::uint32_t tile) {
  return advance(texture.tiles, std::uint64_t{tile} / 2 * record_alignment);
}
constexpr std::size_t tile_entry_offset(std::uint32_t tile) { return tile % 2 * sizeof(Address); }

}  // namespace dmpc::core
