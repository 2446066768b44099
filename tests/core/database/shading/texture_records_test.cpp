#include "core/database/shading/texture_records.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "core/base/expect.h"
#include "core/picture/surfaces/texture_lookup.h"
#include "core/record/texture_layout.h"
#include "tests/support/noise_texture.h"
#include "tests/support/shown_texture.h"

namespace dmpc::core::texture_records_test {

namespace {

/// What rays of all sizes and directions cover of it.
std::vector<TextureFootprint> footprints_on(const TexturedNormals& triangle, std::mt19937& random) {
  std::vector<TextureFootprint> footprints;
  std::uniform_real_distribution<double> share(0, 1), exponent(-10, 3);
  std::uniform_real_distribution<float> change(-1, 1);
  for (int i = 0; i < 60; ++i) {
    double u = i < 3 ? i % 2 : share(random), v = i < 3 ? i / 2 : share(random);  // the corners first
    if (u + v > 1) {
      u = 1 - u, v = 1 - v;
    }
    const CutEllipse ellipse{{{{change(random), change(random)}, {change(random), change(random)}}}};
    footprints.push_back(footprint_of(triangle, u, v, ellipse, std::exp2(exponent(random))));
  }
  return footprints;
}

}  // namespace

TEST_CASE("a triangle's tiles are all that any look-up on it asks for") {
  std::mt19937 random(5);
  for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}) {
    const tests::ShownTexture shown(tests::noise_texture(100, 61, wrap, wrap));
    const TextureReference& reference = shown.reference();
    std::uniform_real_distribution<float> middle(-3, 3), size(0, 0.3F);
    std::size_t fewest = tile_count(reference);
    for (int round = 0; round < 100; ++round) {
      TexturedNormals triangle{.texture = reference};
      const float s = middle(random), t = middle(random);
      for (auto& place : triangle.place) {
        place = {s + size(random), t + size(random)};
      }
      std::set<Address> allowed;
      for_each_tile(triangle, triangle.texture, [&](std::uint32_t tile) { allowed.insert(shown.tile(tile)); });
      fewest = std::min(fewest, allowed.size());
      for (const TextureFootprint& footprint : footprints_on(triangle, random)) {
        TextureLookup lookup = begin_lookup(reference, footprint);
        Operations operations;
        float alpha = 0;
        while (!is_finished(lookup)) {
          const Address address = record_needed(lookup);
          if (lookup.is_found) {
            CHECK(allowed.contains(address));
          }
          step(lookup, footprint.middle, shown.records().find(address), operations, alpha);
        }
      }
    }
    CHECK(fewest < tile_count(reference) / 4);  // not simply all of them
  }
}

TEST_CASE("a small triangle takes few tiles wherever it lies, on whatever turn round the texture") {
  for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror}) {
    const tests::ShownTexture shown(tests::noise_texture(64, 64, wrap, wrap));
    for (const float turn : {-7.0F, -2.0F, -1.0F, 0.0F, 1.0F, 6.0F}) {
      TexturedNormals triangle{.texture = shown.reference()};
      triangle.place = {{{turn + 0.45F, 0.45F}, {turn + 0.46F, 0.45F}, {turn + 0.45F, 0.46F}}};
      std::size_t count = 0;
      for_each_tile(triangle, triangle.texture, [&](std::uint32_t) { ++count; });
      CHECK(count <= 3 * 4 + 4);  // of 88: at most four on each level but those that are one tile
    }
  }
}

TEST_CASE("neighbouring tiles share pages") {
  const tests::ShownTexture shown(tests::noise_texture(64, 64));
  const auto page = [&](std::uint32_t column, std::uint32_t row) { return byte_offset(shown.tile(row * 8 + column)) / 1024; };
  CHECK(page(2, 2) == page(3, 2));
  CHECK(page(2, 2) == page(2, 3));
  CHECK(page(2, 2) == page(3, 3));
  CHECK(page(3, 3) != page(4, 3));
}

TEST_CASE("a texture that is too large for its records is refused, with its name and size") {
  Texture texture{.name = "sky.png", .levels = {{65536, 2, {}}}};
  RecordWriter writer(1024);
  CHECK_THROWS_WITH_AS(reference_to(texture, writer),
                       "sky.png: a texture of 65536x2 texels; there may be 65535 along a side: make it smaller", InputError);
  texture.levels.front().width = 65535;
  CHECK(reference_to(texture, writer).width == 65535);
}

}  // namespace dmpc::core::texture_records_test
