#include "core/database/shading/sky_records.h"

#include <algorithm>
#include <numbers>

#include "core/base/expect.h"
#include "core/database/shading/choice_tree.h"
#include "core/record/sky.h"
#include "core/scene/sky_cells.h"

namespace dmpc::core {
namespace {

/// The minimum for all cells relative to the mean strength, so that the weakest are drawn as often as they should be.
constexpr double sky_share_min = 0x1p-20;

/// Rows wrap around, and beyond a pole the row that ends there is repeated. Texels beyond the last cells have no effect.
TextureTile tile_at(const SkyTexels& sky, std::uint32_t tile_column, std::uint32_t tile_row) {
  TextureTile tile;
  for (std::uint32_t row = 0; row < tile_side; ++row) {
    const std::uint32_t below = tile_row * sky_tile_cells + row;  // of the texel's row; rows begin at 1
    const std::uint32_t from_row = std::clamp(below, 1U, sky.height) - 1;
    for (std::uint32_t column = 0; column < tile_side; ++column) {
      const std::uint32_t from_column = (tile_column * sky_tile_cells + column) % sky.width;
      tile.texel[row * tile_side + column] = sky.texels[std::size_t{from_row} * sky.width + from_column];
    }
  }
  return tile;
}

SkyCells cells_of(const SkyRecords& records, std::uint32_t tile) {
  return SkyCells(records.reference, tile, reinterpret_cast<const std::byte*>(&records.tiles[tile]));
}

double strength_of(const SkyRecords& records) {
  double strength = 0;
  for (std::uint32_t tile = 0; tile < records.tiles.size(); ++tile) {
    strength += cells_of(records, tile).strength();
  }
  return strength;
}

}  // namespace

SkyRecords sky_records(const SkyTexels& sky, const Vec3d& middle, const Vec3d& up) {
  expect(sky.is_there(), "a picture is there");
  SkyRecords records;
  SkyReference& reference = records.reference;
  reference.width = static_cast<std::uint16_t>(sky.width);
  reference.height = static_cast<std::uint16_t>(sky.height);
  reference.scale = static_cast<float>(sky.scale);
  reference.middle = middle;
  reference.up = up;
  for (std::uint32_t row = 0; row < sky_tile_rows(reference); ++row) {
    for (std::uint32_t column = 0; column < sky_tile_columns(reference); ++column) {
      records.tiles.push_back(tile_at(sky, column, row));
    }
  }
  constexpr double all_directions = 4 * std::numbers::pi;
  const double strength = strength_of(records);
  reference.least_strength = static_cast<float>(strength / all_directions * sky_share_min);
  reference.density = static_cast<float>(1 / (strength + all_directions * double{reference.least_strength}));
  std::vector<double> weights;
  weights.reserve(records.tiles.size());
  for (std::uint32_t tile = 0; tile < records.tiles.size(); ++tile) {
    weights.push_back(cells_of(records, tile).all());
  }
  records.choices = choice_tree(weights);
  return records;
}

}  // namespace dmpc::core
