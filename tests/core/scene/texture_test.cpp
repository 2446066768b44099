#include "core/scene/texture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/sampling.h"
#include "core/record/texture_layout.h"
#include "core/scene/texel.h"
#include "tests/support/noise_texture.h"

namespace dmpc::core::scene_texture_test {

namespace {

constexpr std::uint32_t black = 0, white = 0xffffff;

Texture texture_of(std::uint32_t width, std::uint32_t height, std::vector<std::uint32_t> texels) {
  Texture texture{.levels = {{width, height, std::move(texels)}}};
  add_levels(texture);
  return texture;
}

Vec3d mean_of(const Texture& texture, const TextureLevel& level) {
  Vec3d sum;
  for (const std::uint32_t texel : level.texels) {
    sum = sum + Vec3d(decoded(texture.format, texel));
  }
  return sum * (1.0 / static_cast<double>(level.texels.size()));
}

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

TEST_CASE("levels halve down to a single texel, whatever the sides") {
  const Texture texture = tests::noise_texture(20, 5);
  REQUIRE(texture.levels.size() == 5);
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes = {{20, 5}, {10, 2}, {5, 1}, {2, 1}, {1, 1}};
  for (std::size_t level = 0; level < sizes.size(); ++level) {
    CHECK(std::pair(texture.levels[level].width, texture.levels[level].height) == sizes[level]);
    CHECK(texture.levels[level].texels.size() == sizes[level].first * sizes[level].second);
  }
  CHECK(level_count(1, 1) == 1);
  CHECK(level_count(65535, 1) == 16);
}

TEST_CASE("a texture of one texel has one level") { CHECK(texture_of(1, 1, {white}).levels.size() == 1); }

TEST_CASE("a coarser texel is the mean in linear light, not that of the bytes") {
  const Texture texture = texture_of(2, 2, {black, white, white, black});
  CHECK(texture.levels[1].texels == std::vector<std::uint32_t>{0xbcbcbc});  // half the light is 188 on the curve, not 128
}

TEST_CASE("texels of an odd side count by the share that is covered") {
  const Texture texture = texture_of(5, 1, {white, black, white, black, black});
  CHECK(decoded({}, texture.levels[1].texels[0]).x == doctest::Approx(1.5 / 2.5).epsilon(0.01));  // covers two texels and a half
  CHECK(decoded({}, texture.levels[1].texels[1]).x == doctest::Approx(0.5 / 2.5).epsilon(0.01));
  const Texture five = tests::noise_texture(5, 5, {}, {}, TexelFormat::shared_exponent);
  CHECK(length(mean_of(five, five.levels[1]) - mean_of(five, five.levels[0])) < 0.02 * length(mean_of(five, five.levels[0])));
}

TEST_CASE("the brightest channel is that of all texels") {
  CHECK(texture_of(2, 1, {black, black}).brightest == 0);
  CHECK(texture_of(2, 1, {0x00ff00, black}).brightest == 1);
  CHECK(tests::noise_texture(4, 4, {}, {}, TexelFormat::shared_exponent).brightest > 0);
}

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

}  // namespace dmpc::core::scene_texture_test
