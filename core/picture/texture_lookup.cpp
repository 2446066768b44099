#include "core/picture/texture_lookup.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "core/record/texture_layout.h"
#include "core/scene/texel.h"

namespace dmpc::core {
namespace {

constexpr double coarse_share_unit = 0x1p-16;
constexpr unsigned turn_count = 8;
/// A cone that covers more is taken for this: far beyond the coarsest level.
constexpr double texels_max = 0x1p40;
constexpr double octaves_per_e = 1.4426950408889634;  // 1 / ln 2

/// A place's two neighbours along one side.
struct Neighbours {
  std::array<std::uint32_t, 2> texel{};
  std::array<double, 2> weight{};

  std::uint32_t tile(std::size_t which) const { return texel[which] / tile_side; }
  /// Whether the one on the far side counts, and lies in another tile.
  bool has_second_tile() const { return tile(1) != tile(0) && weight[1] > 0; }
};

/// The largest whole number that is not above `value`, which is small enough; std::floor calls a function.
double floor_of(double value) {
  const auto whole = static_cast<double>(static_cast<std::int64_t>(value));
  return whole > value ? whole - 1 : whole;
}

/// The same place with its whole turns round the texture taken off.
double reduced(double place, TextureWrap wrap) {
  switch (wrap) {
    case TextureWrap::repeat:
      return place - floor_of(place);
    case TextureWrap::mirror:
      return place - 2 * floor_of(place / 2);
    case TextureWrap::clamp:
      break;
  }
  return std::clamp(place, -1.0, 2.0);
}

/// Of a texel that a reduced place may have for its neighbour.
std::uint32_t wrapped(std::int64_t texel, std::int64_t size, TextureWrap wrap) {
  if (wrap != TextureWrap::clamp) {
    const std::int64_t period = wrap == TextureWrap::mirror ? 2 * size : size;
    texel += texel < 0 ? period : texel >= period ? -period : 0;
    texel = texel < size ? texel : 2 * size - 1 - texel;
  }
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(texel, 0, size - 1));
}

Neighbours neighbours_of(double place, std::uint32_t size, TextureWrap wrap) {
  const double middle = reduced(place, wrap) * size - 0.5, below = floor_of(middle);
  const auto first = static_cast<std::int64_t>(below);
  return {{wrapped(first, size, wrap), wrapped(first + 1, size, wrap)}, {1 - (middle - below), middle - below}};
}

/// What a look-up meets on the level of a turn.
struct LevelView {
  bool is_coarse;
  std::uint32_t level;
  double share;
  Neighbours columns, rows;

  LevelView(const TextureLookup& lookup, const TexturePlace& place, std::uint32_t turn) : is_coarse(turn >= turn_count / 2) {
    const double coarse = lookup.coarse_share * coarse_share_unit;
    level = lookup.level + (is_coarse ? 1U : 0U);
    share = is_coarse ? coarse : 1 - coarse;
    columns = neighbours_of(place.s, level_size(lookup.texture.width, level), lookup.texture.wrap_s);
    rows = neighbours_of(place.t, level_size(lookup.texture.height, level), lookup.texture.wrap_t);
  }
};

std::size_t column_of(std::uint32_t turn) { return turn & 1U; }
std::size_t row_of(std::uint32_t turn) { return turn >> 1U & 1U; }

bool has_tile(const LevelView& view, std::uint32_t turn) {
  return (column_of(turn) == 0 || view.columns.has_second_tile()) && (row_of(turn) == 0 || view.rows.has_second_tile());
}

/// Makes the tile of a turn the one that is due.
void take(TextureLookup& lookup, const LevelView& view, std::uint32_t turn) {
  const std::uint32_t column = view.columns.tile(column_of(turn)), row = view.rows.tile(row_of(turn));
  lookup.tile = first_tile(lookup.texture, view.level) + row * tile_columns(lookup.texture, view.level) + column;
  lookup.turn = turn & (2 * turn_count - 1);
}

/// Takes the first turn from `first` on that has a tile of its own, on the level of `view` or the coarser one.
void seek(TextureLookup& lookup, const TexturePlace& place, const LevelView& view, std::uint32_t first) {
  const std::uint32_t end = view.is_coarse ? turn_count : turn_count / 2;
  for (std::uint32_t turn = first; turn < end; ++turn) {
    if (has_tile(view, turn)) {
      return take(lookup, view, turn);
    }
  }
  if (view.is_coarse || lookup.coarse_share == 0) {
    lookup.turn = turn_count;
  } else {
    take(lookup, LevelView(lookup, place, end), end);
  }
}

/// Adds those of the four texels that lie in the tile of this turn.
void add_texels(TextureLookup& lookup, const LevelView& view, const std::byte* tile) {
  const std::uint32_t tile_column = view.columns.tile(column_of(lookup.turn)), tile_row = view.rows.tile(row_of(lookup.turn));
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t column = 0; column < 2; ++column) {
      if (view.columns.tile(column) != tile_column || view.rows.tile(row) != tile_row) {
        continue;
      }
      const std::size_t index = view.rows.texel[row] % tile_side * tile_side + view.columns.texel[column] % tile_side;
      const double weight = view.share * view.rows.weight[row] * view.columns.weight[column];
      const Color color = decoded(lookup.texture.format, read<std::uint32_t>(tile + index * sizeof(std::uint32_t)));
      lookup.sum = lookup.sum + color * static_cast<float>(weight);
    }
  }
}

}  // namespace

TextureLookup begin_lookup(const TextureReference& texture, const TexturePlace& place, double texels) {
  TextureLookup lookup{.texture = texture};
  const double detail = texels > 1 ? natural_log(std::min(texels, texels_max)) * octaves_per_e : 0;
  const double level = floor_of(detail), coarsest = texture.level_count - 1;
  lookup.level = static_cast<std::uint8_t>(std::min(level, coarsest));
  lookup.coarse_share = level < coarsest ? static_cast<std::uint16_t>((detail - level) / coarse_share_unit) : std::uint16_t{0};
  seek(lookup, place, LevelView(lookup, place, 0), 0);
  return lookup;
}

bool is_finished(const TextureLookup& lookup) { return lookup.turn == turn_count; }

Address record_needed(const TextureLookup& lookup) {
  return lookup.is_found ? Address{lookup.tile} : tile_entry_address(lookup.texture, lookup.tile);
}

void step(TextureLookup& lookup, const TexturePlace& place, const std::byte* record, Operations& operations) {
  if (!lookup.is_found) {
    const auto address = read<Address>(record + tile_entry_offset(lookup.tile));
    expect(address != no_address, "whoever has a textured triangle has the tiles of its texture that it needs");
    lookup.tile = static_cast<std::uint32_t>(address);
    lookup.is_found = true;
    return;
  }
  const LevelView view(lookup, place, lookup.turn);
  add_texels(lookup, view, record);
  ++operations.tile_reads;
  lookup.is_found = false;
  seek(lookup, place, view, lookup.turn + 1U);
}

}  // namespace dmpc::core
