#include "core/picture/surfaces/texture_lookup.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/scene/texel.h"
#include "tests/support/noise_texture.h"
#include "tests/support/shown_texture.h"

namespace dmpc::core::picture_texture_lookup_test {

namespace {

constexpr auto repeat = TextureWrap::repeat, mirror = TextureWrap::mirror, clamp = TextureWrap::clamp;

using tests::ShownTexture;

void check_near(const Color& color, const Vec3d& expected, double tolerance) {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    CHECK(std::fabs(double{color[channel]} - expected[channel]) <= tolerance);
  }
}

}  // namespace

TEST_CASE("a look-up is the blend of the eight texels about it, for every way to go on beyond an edge") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-2.5, 3.5), detail(-1, 8);
  for (const TextureWrap wrap_s : {repeat, mirror, clamp}) {
    for (const TextureWrap wrap_t : {repeat, mirror, clamp}) {
      ShownTexture shown(tests::noise_texture(37, 20, wrap_s, wrap_t));
      for (int i = 0; i < 300; ++i) {
        const TexturePlace at{place(random), place(random)};
        const double texels = std::exp2(detail(random));
        CAPTURE(at.s);
        CAPTURE(at.t);
        CAPTURE(texels);
        check_near(shown.look_up(at, texels), shown.expected(at, texels), 2e-5);
      }
    }
  }
}

TEST_CASE("in the middle of a texel a look-up gives that texel, to the last bit") {
  ShownTexture shown(tests::noise_texture(16, 8));
  for (std::uint32_t texel = 0; texel < 128; ++texel) {
    const TexturePlace middle{(texel % 16 + 0.5) / 16, (texel / 16 + 0.5) / 8};
    CHECK(shown.look_up(middle, 0) == decoded({}, shown.texture().levels[0].texels[texel]));
    CHECK(shown.look_up(middle, 1) == decoded({}, shown.texture().levels[0].texels[texel]));
  }
}

TEST_CASE("a look-up reads the tiles that it blends and no other: one at the least, eight at the most") {
  ShownTexture shown(tests::noise_texture(64, 64));
  shown.look_up({4.0 / 64, 4.0 / 64}, 1);
  CHECK(shown.tiles_read.size() == 1);
  shown.look_up({8.0 / 64, 4.0 / 64}, 1);
  CHECK(shown.tiles_read.size() == 2);
  shown.look_up({8.0 / 64, 8.0 / 64}, 1);
  CHECK(shown.tiles_read.size() == 4);
  shown.look_up({16.0 / 64, 16.0 / 64}, 1.5);
  CHECK(shown.tiles_read.size() == 8);
  shown.look_up({7.5 / 64, 4.0 / 64}, 1);  // the neighbour in the next tile has no weight
  CHECK(shown.tiles_read.size() == 1);
}

TEST_CASE("what covers the whole texture gets its mean, whatever the size of what covers it") {
  ShownTexture shown(tests::noise_texture(32, 32));
  const Color mean = decoded({}, shown.texture().levels.back().texels[0]);
  for (const double texels : {32.0, 33.0, 1e6, 1e30, HUGE_VAL}) {
    CHECK(shown.look_up({0.3, 0.8}, texels) == mean);
    CHECK(shown.tiles_read.size() == 1);
  }
}

TEST_CASE("a texture of a single texel has one colour everywhere") {
  ShownTexture shown(tests::noise_texture(1, 1));
  CHECK(shown.look_up({0, 0}, 0) == shown.look_up({-17.25, 1e5}, 100));
}

TEST_CASE("a look-up along a line is the mean of its probes, those at its ends by what is left for them") {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> place(-2.5, 3.5), step(-0.1, 0.1), detail(-1, 6), strides(1, probes_max);
  for (const TextureWrap wrap : {repeat, mirror, clamp}) {
    ShownTexture shown(tests::noise_texture(37, 20, wrap, wrap));
    for (int i = 0; i < 300; ++i) {
      const TextureFootprint line{
          {place(random), place(random)}, {step(random), step(random)}, std::exp2(detail(random)), strides(random)};
      CAPTURE(line.strides);
      check_near(shown.look_up(line), shown.expected(line), 1e-4);
    }
  }
}

TEST_CASE("nothing jumps where a line gets two more probes") {
  ShownTexture shown(tests::noise_texture(64, 64));
  TextureFootprint line{{0.4, 0.6}, {0.03, 0.02}, 1.5, 1};
  Color before = shown.look_up(line);
  for (; line.strides < probes_max; line.strides += 0.001) {
    const Color now = shown.look_up(line);
    check_near(now, Vec3d(before), 2e-3);
    before = now;
  }
}

TEST_CASE("probes that follow each other in a tile read it once") {
  ShownTexture shown(tests::noise_texture(64, 64));
  shown.look_up({{4.0 / 64, 4.0 / 64}, {1.0 / 64, 0}, 1, 5});
  CHECK(shown.tiles_read.size() == 1);
  CHECK(shown.tile_steps == 1);
  shown.look_up({{8.0 / 64, 4.0 / 64}, {1.0 / 64, 0}, 1, 5});
  CHECK(shown.tiles_read.size() == 2);
  CHECK(shown.tile_steps <= 4);
}

TEST_CASE("the sum of all weights is 1 wherever the place lies") {
  Texture white{.levels = {{100, 3, std::vector<std::uint32_t>(300, 0xffffff)}}};
  add_levels(white);
  ShownTexture shown(std::move(white));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1e5, 1e5), texels(0, 200), strides(1, probes_max);
  for (int i = 0; i < 1000; ++i) {
    check_near(shown.look_up({place(random), place(random)}, texels(random)), {1, 1, 1}, 1e-6);
    const TextureFootprint line{{place(random), place(random)}, {place(random), place(random)}, texels(random), strides(random)};
    check_near(shown.look_up(line), {1, 1, 1}, 1e-4);
  }
}

}  // namespace dmpc::core::picture_texture_lookup_test
