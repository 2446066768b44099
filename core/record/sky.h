// How a sky's picture is cut into tiles: by those who write them, and by those who read them.
#pragma once

#include <cstdint>

#include "core/base/units.h"
#include "core/record/choice_node.h"
#include "core/record/record.h"

namespace dmpc::core {

/// A picture shows its sky between the middles of its texels, so it is looked at by cells, each between four of them: as many in
/// a row as there are texels, since rows close, and a row more than texels have, since the first and the last are half as high
/// and end at the poles. A tile has all the texels of 7x7 cells, those at its edges with its neighbours: so one record answers.
inline constexpr std::uint32_t sky_tile_cells = tile_side - 1;

inline bool has_sky_picture(const DatabaseHeader& header) { return header.sky.tiles != no_address; }

constexpr std::uint32_t sky_tile_columns(const SkyReference& sky) {
  return ceil_divide(std::uint32_t{sky.width}, sky_tile_cells);
}
constexpr std::uint32_t sky_tile_rows(const SkyReference& sky) {
  return ceil_divide(std::uint32_t{sky.height} + 1, sky_tile_cells);
}
constexpr std::uint32_t sky_tile_count(const SkyReference& sky) { return sky_tile_columns(sky) * sky_tile_rows(sky); }

constexpr Address sky_tile_address(const SkyReference& sky, std::uint32_t tile) {
  return advance(sky.tiles, std::uint64_t{tile} * sizeof(TextureTile));
}
constexpr Address sky_choice_address(const SkyReference& sky, std::uint32_t node) {
  return advance(sky.choices, std::uint64_t{node} * sizeof(ChoiceNode));
}

}  // namespace dmpc::core
