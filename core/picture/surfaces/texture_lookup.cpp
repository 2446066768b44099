#include "core/picture/surfaces/texture_lookup.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "core/record/texture_layout.h"
#include "core/scene/texel.h"

namespace dmpc::core {
namespace {

constexpr double share_unit = 0x1p-16;
constexpr double share_max = 65535;
constexpr std::uint32_t quarter_count = 4;
/// The range of TextureLookup::tile: addresses of 16 GiB, more than a database has.
constexpr std::uint32_t tile_mask = 0x7fffffff;
/// Larger probes are clamped to this width, far beyond the coarsest level.
constexpr double footprint_width_max = 0x1p40;
constexpr double octaves_per_e = 1.4426950408889634;  // 1 / ln 2

/// The two neighbours of a coordinate along one side.
struct Neighbours {
  std::array<std::uint32_t, 2> texel{};
  std::array<double, 2> weight{};

  std::uint32_t tile(std::size_t which) const { return texel[which] / tile_side; }
  /// Whether the second one has a weight and lies in another tile.
  bool has_second_tile() const { return tile(1) != tile(0) && weight[1] > 0; }
};

/// The floor of `value`, which is small enough; std::floor would be a function call.
double floor_of(double value) {
  const auto whole = static_cast<double>(static_cast<std::int64_t>(value));
  return whole > value ? whole - 1 : whole;
}

/// A coordinate reduced to the texture's range.
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

/// The index of a texel that may be a neighbour of a reduced coordinate.
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

TextureReference reference_of(const TextureLookup& lookup) {
  return {.tiles = lookup.tiles, .width = lookup.width, .height = lookup.height};
}

/// A probe beside the middle: its offset in strides, and its weight.
struct Probe {
  double offset = 0, weight = 1;
};

/// Strides are laid side by side from the middle of the line outwards. The rest at each end is a probe of a corresponding weight
/// whose outer edge is at the end of the line, so the result is continuous where the number of probes changes.
Probe probe_of(const TextureLookup& lookup) {
  if (lookup.ends == 0) {
    return {};
  }
  const double ends = lookup.ends, end = (lookup.end_share + 1) * share_unit, strides = 2 * ends - 1 + 2 * end;
  const double number = static_cast<double>(lookup.probe) - ends;
  if (std::fabs(number) < ends) {
    return {number, 1 / strides};
  }
  return {std::copysign(ends - 1 + lookup.end_share * share_unit, number), end / strides};
}

/// The texels of a probe on its level.
struct ProbeView {
  std::uint32_t level;
  double weight;
  Neighbours columns, rows;

  ProbeView(const TextureLookup& lookup, const TexturePlace& middle) : level(lookup.level + lookup.is_coarse) {
    const Probe probe = probe_of(lookup);
    const double coarse = lookup.coarse_share * share_unit;
    weight = probe.weight * (lookup.is_coarse != 0 ? coarse : 1 - coarse);
    columns = neighbours_of(middle.s + probe.offset * double{lookup.stride[0]}, level_size(lookup.width, level), lookup.wrap_s);
    rows = neighbours_of(middle.t + probe.offset * double{lookup.stride[1]}, level_size(lookup.height, level), lookup.wrap_t);
  }

  static std::size_t column_of(std::uint32_t quarter) { return quarter & 1U; }
  static std::size_t row_of(std::uint32_t quarter) { return quarter >> 1U; }
  bool has_tile(std::uint32_t quarter) const {
    return (column_of(quarter) == 0 || columns.has_second_tile()) && (row_of(quarter) == 0 || rows.has_second_tile());
  }
};

/// The tile's index in the texture's table.
std::uint32_t tile_of(const TextureLookup& lookup, const ProbeView& view, std::uint32_t first_of_level) {
  const std::uint32_t column = view.columns.tile(ProbeView::column_of(lookup.quarter));
  const std::uint32_t row = view.rows.tile(ProbeView::row_of(lookup.quarter));
  return first_of_level + row * tile_columns(reference_of(lookup), view.level) + column;
}

/// Advances to the probe's next quarter that has a tile of its own.
bool next_quarter(TextureLookup& lookup, const ProbeView& view) {
  for (std::uint32_t quarter = lookup.quarter + 1; quarter < quarter_count; ++quarter) {
    if (view.has_tile(quarter)) {
      lookup.quarter = quarter & (quarter_count - 1);
      return true;
    }
  }
  return false;
}

/// Advances to the next probe on this level, whose first tile comes next.
bool next_probe(TextureLookup& lookup) {
  lookup.quarter = 0;
  if (lookup.probe == 2 * lookup.ends) {
    return false;
  }
  ++lookup.probe;
  return true;
}

bool next_level(TextureLookup& lookup) {
  if (lookup.is_coarse != 0 || lookup.coarse_share == 0) {
    return false;
  }
  lookup.is_coarse = 1;
  lookup.probe = 0;
  return true;
}

/// Adds those of the four texels that lie in this quarter's tile.
void add_texels(TextureLookup& lookup, const ProbeView& view, const std::byte* tile, float& alpha) {
  const std::uint32_t tile_column = view.columns.tile(ProbeView::column_of(lookup.quarter));
  const std::uint32_t tile_row = view.rows.tile(ProbeView::row_of(lookup.quarter));
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t column = 0; column < 2; ++column) {
      if (view.columns.tile(column) != tile_column || view.rows.tile(row) != tile_row) {
        continue;
      }
      const std::size_t index = view.rows.texel[row] % tile_side * tile_side + view.columns.texel[column] % tile_side;
      auto weight = static_cast<float>(view.weight * view.rows.weight[row] * view.columns.weight[column]);
      const auto texel = read<std::uint32_t>(tile + index * sizeof(std::uint32_t));
      if (lookup.format == TexelFormat::srgb_alpha) {
        weight *= alpha_of(lookup.format, texel);
        alpha += weight;
      }
      lookup.sum = lookup.sum + decoded(lookup.format, texel) * weight;
    }
  }
}

/// Finishes the current level and probe and advances to the next ones.
void take(TextureLookup& lookup, const TexturePlace& middle) {
  const ProbeView view(lookup, middle);
  lookup.tile = tile_of(lookup, view, first_tile(reference_of(lookup), view.level)) & tile_mask;
}

/// Reads from a tile everything that consecutive probes on its level find there.
void read_tile(TextureLookup& lookup, const TexturePlace& middle, const std::byte* tile, Operations& operations, float& alpha) {
  ProbeView view(lookup, middle);
  const std::uint32_t first_of_level = first_tile(reference_of(lookup), view.level);
  const std::uint32_t here = tile_of(lookup, view, first_of_level);
  for (;;) {
    add_texels(lookup, view, tile, alpha);
    ++operations.tile_reads;
    if (!next_quarter(lookup, view)) {
      if (!next_probe(lookup)) {
        break;
      }
      view = ProbeView(lookup, middle);
    }
    lookup.tile = tile_of(lookup, view, first_of_level) & tile_mask;
    if (lookup.tile != here) {
      return;
    }
  }
  if (next_level(lookup)) {
    take(lookup, middle);
  } else {
    lookup.is_done = 1;
  }
}

/// Distributes the probes along the footprint's line.
void place_probes(TextureLookup& lookup, const TextureFootprint& footprint) {
  constexpr double towards_zero = 1 - 0x1p-23;  // keeps probes within the line's ends
  const double ends = -floor_of((1 - footprint.strides) / 2);
  if (ends > 0) {
    const double end = (footprint.strides - (2 * ends - 1)) / 2;
    lookup.ends = static_cast<std::uint32_t>(ends) & 7U;
    lookup.end_share = static_cast<std::uint16_t>(std::clamp(end / share_unit - 1, 0.0, share_max));
    lookup.stride = {static_cast<float>(footprint.stride.s * towards_zero),
                     static_cast<float>(footprint.stride.t * towards_zero)};
  }
}

}  // namespace

TextureLookup begin_lookup(const TextureReference& texture, const TextureFootprint& footprint) {
  TextureLookup lookup;
  place_probes(lookup, footprint);
  turn_to(lookup, texture, footprint.width, footprint.middle);
  return lookup;
}

void turn_to(TextureLookup& lookup, const TextureReference& texture, double width, const TexturePlace& middle) {
  lookup = TextureLookup{.stride = lookup.stride,
                         .tiles = texture.tiles,
                         .width = texture.width,
                         .height = texture.height,
                         .end_share = lookup.end_share,
                         .format = texture.format,
                         .wrap_s = texture.wrap_s,
                         .wrap_t = texture.wrap_t,
                         .ends = lookup.ends};
  const double detail = width > 1 ? natural_log(std::min(width, footprint_width_max)) * octaves_per_e : 0;
  const double level = floor_of(detail), coarsest = texture.level_count - 1;
  lookup.level = static_cast<std::uint32_t>(std::min(level, coarsest)) & 15U;
  lookup.coarse_share = level < coarsest ? static_cast<std::uint16_t>((detail - level) / share_unit) : std::uint16_t{0};
  take(lookup, middle);
}

Address record_needed(const TextureLookup& lookup) {
  return lookup.is_found != 0 ? Address{lookup.tile} : tile_entry_address(reference_of(lookup), lookup.tile);
}

void step(TextureLookup& lookup, const TexturePlace& middle, const std::byte* record, Operations& operations, float& alpha) {
  if (lookup.is_found == 0) {
    const auto address = read<Address>(record + tile_entry_offset(lookup.tile));
    expect(address != no_address, "whoever has a textured triangle has the tiles of its texture that it needs");
    lookup.tile = static_cast<std::uint32_t>(address) & tile_mask;
    lookup.is_found = 1;
    return;
  }
  lookup.is_found = 0;
  read_tile(lookup, middle, record, operations, alpha);
}

}  // namespace dmpc::core
