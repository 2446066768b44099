// A texture in records, and the same on the host.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "core/database/record_writer.h"
#include "core/database/shading/texture_records.h"
#include "core/picture/surfaces/texture_lookup.h"
#include "core/record/records.h"
#include "core/record/texture_layout.h"
#include "core/scene/texel.h"
#include "core/scene/texture.h"

namespace dmpc::tests {

/// Looked up in by records as shading does, and by the definition.
class ShownTexture {
 public:
  explicit ShownTexture(core::Texture texture) : texture_(std::move(texture)) {
    core::RecordWriter writer(1024);
    reference_ = core::reference_to(texture_, writer);
    core::write_tiles(texture_, reference_, writer);
    bytes_ = std::move(writer).finish();
  }

  /// By the records, one a step.
  core::Color look_up(const core::TexturePlace& place, double texels) {
    return look_up({.middle = place, .stride = {}, .width = texels});
  }
  core::Color look_up(const core::TextureFootprint& footprint) {
    tiles_read.clear();
    tile_steps = 0;
    core::TextureLookup lookup = core::begin_lookup(reference_, footprint);
    core::Operations operations;
    alpha = 0;
    while (!core::is_finished(lookup)) {
      const core::Address address = core::record_needed(lookup);
      if (lookup.is_found) {
        ++tile_steps;
        const bool is_new = tiles_read.insert(address).second;
        CHECK((is_new || footprint.strides > 1));  // a single probe reads none twice
      }
      core::step(lookup, footprint.middle, records().find(address), operations, alpha);
    }
    CHECK(operations.tile_reads >= tiles_read.size());
    return lookup.sum;
  }

  /// By the definition: the blend of two levels, each the blend of four texels.
  core::Vec3d expected(const core::TexturePlace& place, double texels) const {
    const double detail = std::max(0.0, std::log2(std::max(texels, 1e-30)));
    const auto coarsest = static_cast<double>(texture_.levels.size() - 1);
    const double level = std::min(std::floor(detail), coarsest);
    const double share = level < coarsest ? detail - level : 0;
    const auto index = static_cast<std::size_t>(level);
    const core::Vec3d coarse = share > 0 ? blend(texture_.levels[index + 1], place) : core::Vec3d{};
    return blend(texture_.levels[index], place) * (1 - share) + coarse * share;
  }

  /// By the definition: the mean over probes of a stride each, from the middle of the line outwards.
  core::Vec3d expected(const core::TextureFootprint& line) const {
    core::Vec3d sum = expected(line.middle, line.width);
    for (double left = (line.strides - 1) / 2, offset = 0; left > 0; left -= 1) {
      const double share = std::min(left, 1.0);
      offset += share;
      for (const double off : {-offset, offset}) {
        sum = sum + expected({line.middle.s + off * line.stride.s, line.middle.t + off * line.stride.t}, line.width) * share;
      }
    }
    return sum * (1 / line.strides);
  }

  const core::Texture& texture() const { return texture_; }
  const core::TextureReference& reference() const { return reference_; }
  core::LocalRecords records() const { return core::LocalRecords(bytes_); }
  /// Where the tile of a number is.
  core::Address tile(std::uint32_t number) const {
    return core::read<core::Address>(records().find(core::tile_entry_address(reference_, number)) +
                                     core::tile_entry_offset(number));
  }
  std::set<core::Address> tiles_read;  ///< by the last look-up
  float alpha = 0;                     ///< what it found of that, in a format that has it
  int tile_steps = 0;                  ///< number of its steps that read a tile

 private:
  static std::uint32_t wrapped(double texel, std::uint32_t size, core::TextureWrap wrap) {
    const auto period = static_cast<double>(size);
    if (wrap == core::TextureWrap::clamp) {
      return static_cast<std::uint32_t>(std::min(std::max(texel, 0.0), period - 1));
    }
    if (wrap == core::TextureWrap::repeat) {
      return static_cast<std::uint32_t>(texel - period * std::floor(texel / period));
    }
    const double turned = texel - 2 * period * std::floor(texel / (2 * period));
    return static_cast<std::uint32_t>(turned < period ? turned : 2 * period - 1 - turned);
  }

  core::Vec3d blend(const core::TextureLevel& level, const core::TexturePlace& place) const {
    const double x = place.s * level.width - 0.5, y = place.t * level.height - 0.5;
    core::Vec3d sum;
    for (int corner = 0; corner < 4; ++corner) {
      const double column = std::floor(x) + corner % 2, row = std::floor(y) + corner / 2;
      const double weight = (1 - std::fabs(x - column)) * (1 - std::fabs(y - row));
      const std::size_t texel =
          std::size_t{wrapped(row, level.height, texture_.wrap_t)} * level.width + wrapped(column, level.width, texture_.wrap_s);
      sum = sum + core::Vec3d(core::decoded(texture_.format, level.texels[texel])) * weight;
    }
    return sum;
  }

  core::Texture texture_;
  core::TextureReference reference_;
  std::vector<std::byte> bytes_;
};

}  // namespace dmpc::tests
