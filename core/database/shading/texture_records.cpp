#include "core/database/shading/texture_records.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "core/base/expect.h"
#include "core/base/morton.h"
#include "core/record/texture_layout.h"

namespace dmpc::core {
namespace {

struct TilePlace {
  std::uint32_t column = 0, row = 0;
};

std::vector<TilePlace> in_morton_order(std::uint32_t columns, std::uint32_t rows) {
  std::vector<TilePlace> places;
  places.reserve(std::size_t{columns} * rows);
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      places.push_back({column, row});
    }
  }
  const auto code = [](const TilePlace& place) { return morton_code(place.column, place.row, 0); };
  std::sort(places.begin(), places.end(), [&](const auto& a, const auto& b) { return code(a) < code(b); });
  return places;
}

TextureTile tile_at(const TextureLevel& level, const TilePlace& place) {
  TextureTile tile;
  const std::uint32_t left = place.column * tile_side, top = place.row * tile_side;
  const std::uint32_t width = std::min(tile_side, level.width - left), height = std::min(tile_side, level.height - top);
  for (std::uint32_t row = 0; row < height; ++row) {
    const auto from = level.texels.begin() + static_cast<std::ptrdiff_t>(std::size_t{top + row} * level.width + left);
    std::copy_n(from, width, tile.texel.begin() + row * tile_side);
  }
  return tile;
}

/// The first and last tile of a range along one side.
using Run = std::pair<std::uint32_t, std::uint32_t>;

/// The tiles around all coordinates from `low` to `high` on a side of `size` texels; all if they cross the texture's edge.
Run tiles_between(double low, double high, std::uint32_t size, TextureWrap wrap) {
  constexpr double rounding = 0x1p-20;  // coordinates are below 2^20, as are sums of three in double
  const double first = std::floor((low - rounding) * size - 0.5), last = std::floor((high + rounding) * size - 0.5) + 1;
  if (const double turn = std::floor(low); wrap != TextureWrap::clamp) {
    if (first < turn * size || last >= (turn + 1) * size) {
      return {0, (size - 1) / tile_side};
    }
    const bool is_mirrored = wrap == TextureWrap::mirror && std::floor(turn / 2) * 2 != turn;
    return is_mirrored ? tiles_between(turn + 1 - high, turn + 1 - low, size, TextureWrap::clamp)
                       : tiles_between(low - turn, high - turn, size, TextureWrap::clamp);
  }
  const double most = size - 1;
  return {static_cast<std::uint32_t>(std::clamp(first, 0.0, most)) / tile_side,
          static_cast<std::uint32_t>(std::clamp(last, 0.0, most)) / tile_side};
}

std::pair<double, double> extent_of(const TexturedNormals& triangle, std::size_t side) {
  const auto [low, high] = std::minmax({triangle.place[0][side], triangle.place[1][side], triangle.place[2][side]});
  return {double{low}, double{high}};
}

}  // namespace

TextureReference reference_to(const Texture& texture, RecordWriter& writer) {
  const TextureLevel& finest = texture.levels.front();
  if (std::max(finest.width, finest.height) > Texture::size_max) {
    throw InputError(texture.name + ": a texture of " + std::to_string(finest.width) + "x" + std::to_string(finest.height) +
                     " texels; there may be " + std::to_string(Texture::size_max) + " along a side: make it smaller");
  }
  TextureReference reference{.width = static_cast<std::uint16_t>(finest.width),
                             .height = static_cast<std::uint16_t>(finest.height),
                             .format = texture.format,
                             .wrap_s = texture.wrap_s,
                             .wrap_t = texture.wrap_t,
                             .level_count = static_cast<std::uint8_t>(texture.levels.size())};
  reference.tiles = writer.allocate_array<Address>(tile_entry_count(reference));
  return reference;
}

void write_tiles(const Texture& texture, const TextureReference& reference, RecordWriter& writer) {
  std::vector<Address> table(tile_entry_count(reference), no_address);
  writer.begin_page();
  for (std::uint32_t level = 0; level < reference.level_count; ++level) {
    const std::uint32_t columns = tile_columns(reference, level), first = first_tile(reference, level);
    for (const TilePlace& place : in_morton_order(columns, tile_rows(reference, level))) {
      table[first + place.row * columns + place.column] = writer.add(tile_at(texture.levels[level], place));
    }
  }
  writer.write(reference.tiles, 0, std::as_bytes(std::span(table)));
}

void for_each_tile(const TexturedNormals& triangle, const TextureReference& texture,
                   const std::function<void(std::uint32_t)>& take) {
  const auto [left, right] = extent_of(triangle, 0);
  const auto [top, bottom] = extent_of(triangle, 1);
  for (std::uint32_t level = 0; level < texture.level_count; ++level) {
    const Run columns = tiles_between(left, right, level_size(texture.width, level), texture.wrap_s);
    const Run rows = tiles_between(top, bottom, level_size(texture.height, level), texture.wrap_t);
    const std::uint32_t first = first_tile(texture, level), row_length = tile_columns(texture, level);
    for (std::uint32_t row = rows.first; row <= rows.second; ++row) {
      for (std::uint32_t column = columns.first; column <= columns.second; ++column) {
        take(first + row * row_length + column);
      }
    }
  }
}

}  // namespace dmpc::core
