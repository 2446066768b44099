#include "core/scene/texture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/sampling.h"
#include "core/scene/texel.h"

namespace dmpc::core::alpha_coverage_test {

namespace {

/// How much of a level is there.
double share_there(const TextureLevel& level, double cutoff) {
  const auto count = std::count_if(level.texels.begin(), level.texels.end(), [&](std::uint32_t texel) {
    return double{alpha_of(TexelFormat::srgb_alpha, texel)} >= cutoff;
  });
  return static_cast<double>(count) / static_cast<double>(level.texels.size());
}

/// 64 x 64 texels, of which one in `every` is there, wherever chance has it.
Texture grass(std::uint32_t every, std::uint32_t alpha, double cutoff) {
  std::vector<std::uint32_t> texels;
  for (std::uint32_t i = 0; i < 64 * 64; ++i) {
    texels.push_back(0x204010U | (mix(i) % every == 0 ? alpha : 0U) << 24U);
  }
  Texture texture{.format = TexelFormat::srgb_alpha, .levels = {{64, 64, std::move(texels)}}};
  add_levels(texture);
  keep_coverage(texture, cutoff);
  return texture;
}

}  // namespace

TEST_CASE("where alpha cuts out, as large a share of each level is there as of the finest, as nearly as its texels can tell") {
  for (const double cutoff : {0.1, 0.5, 0.9, 1.0}) {
    CAPTURE(cutoff);
    for (const std::uint32_t every : {2U, 3U, 5U, 9U}) {
      CAPTURE(every);
      const Texture texture = grass(every, 255, cutoff);
      for (const TextureLevel& level : texture.levels) {
        CAPTURE(level.width);
        const double off = std::fabs(share_there(level, cutoff) - share_there(texture.levels[0], cutoff));
        CHECK(off <= (level.width > 2 ? 0.2 : 0.5));  // many texels are alike
      }
    }
  }
  CHECK(share_there(grass(9, 255, 0.5).levels[2], 0.5) > 0);  // of whose means none reaches the cutoff
  CHECK(share_there(grass(2, 255, 0.1).levels[2], 0.1) < 1);  // of whose means all do
}

TEST_CASE("scaling alpha leaves colours, the finest level, and what no cutoff needs as they are") {
  const Texture plain = grass(4, 200, 0), cut = grass(4, 200, 0.5), all = grass(1, 200, 0.5), none = grass(4, 100, 0.5);
  CHECK(cut.levels[0].texels == plain.levels[0].texels);
  for (std::size_t level = 0; level < plain.levels.size(); ++level) {
    for (std::size_t i = 0; i < plain.levels[level].texels.size(); ++i) {
      CHECK((cut.levels[level].texels[i] & 0xffffffU) == (plain.levels[level].texels[i] & 0xffffffU));
    }
    CHECK(all.levels[level].texels == grass(1, 200, 0).levels[level].texels);
    CHECK(none.levels[level].texels == grass(4, 100, 0).levels[level].texels);
  }
}

}  // namespace dmpc::core::alpha_coverage_test
