// A sky's picture, cut into tiles: what comes from where, and how its brightness is aimed at.
#include "core/scene/sky_cells.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/base/sampling.h"
#include "core/database/shading/sky_records.h"
#include "core/picture/lights/choosing.h"
#include "core/picture/sampling/sample_pair.h"
#include "core/record/sky.h"
#include "core/scene/sky_texels.h"
#include "core/scene/texel.h"
#include "tests/support/sky_pictures.h"

namespace sky_cells_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

using std::numbers::pi;

double number_of(std::uint64_t key) { return static_cast<double>(mix(key + 0x9e3779b97f4a7c15ULL) >> 32U) * 0x1p-32; }

/// A sky whose zenith is z and whose middle is x.
struct Sky {
  explicit Sky(const SkyTexels& texels) : records(sky_records(texels, {1, 0, 0}, {0, 0, 1})) {}

  const SkyReference& reference() const { return records.reference; }
  const std::byte* tile(std::uint32_t index) const { return reinterpret_cast<const std::byte*>(&records.tiles[index]); }
  SkyLight towards(const Vec3d& direction) const {
    const SkyPlace place = sky_place(reference(), direction);
    return sky_light(reference(), tile(place.tile), place);
  }
  /// As a hit draws it.
  SkyCells::Drawn draw(std::uint64_t key) const { return draw(number_of(3 * key), number_of(3 * key + 1)); }
  SkyCells::Drawn draw(double x, double y) const {
    const DrawnEmitter drawn = drawn_from(records.choices, static_cast<std::uint32_t>(records.tiles.size()), x, 0);
    return SkyCells(reference(), drawn.index, tile(drawn.index)).draw(double{drawn.place}, y);
  }

  SkyRecords records;
};

/// By angle from the zenith and turn to the left of the middle.
Vec3d direction_of(double from_zenith, double left) {
  return {std::sin(from_zenith) * std::cos(left), std::sin(from_zenith) * std::sin(left), std::cos(from_zenith)};
}

}  // namespace

TEST_CASE("a picture's middle is ahead, its upper edge above, its left half to the left, and its edges meet behind") {
  std::vector<float> rgb;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 8; ++column) {
      rgb.insert(rgb.end(), {static_cast<float>(row), static_cast<float>(column), 1});
    }
  }
  const Sky sky(sky_texels(8, 4, rgb));
  const auto at = [&](const Vec3d& direction) { return sky.towards(direction).radiance; };
  CHECK(at({1, 0, 0}) == Color{1.5F, 3.5F, 1});
  CHECK(at({0, 1, 0}) == Color{1.5F, 1.5F, 1});
  CHECK(at({0, -1, 0}) == Color{1.5F, 5.5F, 1});
  CHECK(at({-1, 0, 0}) == Color{1.5F, 3.5F, 1});  // half-way between 7 and 0
  CHECK(at({0, 0, 1}).x == 0);
  CHECK(at({0, 0, -1}).x == 3);
  const Vec3d middle_of_texel = direction_of(pi * 2.5 / 4, 2 * pi * (0.5 - 6.5 / 8));
  CHECK(at(middle_of_texel).x == doctest::Approx(2));
  CHECK(at(middle_of_texel).y == doctest::Approx(6));
}

TEST_CASE("the middle lies along the axis behind that which is up, and at a right angle to what is nearly that") {
  CHECK(sky_middle({0, 1, 0}) == Vec3d{0, 0, 1});
  CHECK(sky_middle({0, 0, 1}) == Vec3d{1, 0, 0});
  CHECK(sky_middle({1, 0, 0}) == Vec3d{0, 1, 0});
  CHECK(sky_middle({0, -1, 0}) == Vec3d{0, 0, 1});
  const Vec3d up = normalize(Vec3d{0.2, 0.3, 2}), middle = sky_middle(up);
  CHECK(std::fabs(dot(up, middle)) < 1e-15);
  CHECK(std::fabs(length(middle) - 1) < 1e-15);
  CHECK(middle.x > 0.99);
}

TEST_CASE("texels keep what they are to 1 in 512, whatever the light's strength, and pictures of a row or a column show all") {
  for (const float strength : {1e-30F, 1e-3F, 1.0F, 1e6F, 1e29F}) {
    const SkyTexels texels = sky_texels(2, 2,
                                        std::vector<float>{strength, strength / 2, strength / 3, 0, 0, 0,  //
                                                           strength, strength, strength, strength / 100, 0, 0});
    CHECK(texels.brightest == doctest::Approx(double{strength}).epsilon(1.0 / 500).scale(0));
    const Sky sky(texels);
    CHECK(sky.towards(direction_of(0.25 * pi, 0.5 * pi)).radiance.y == doctest::Approx(strength / 2).epsilon(1.0 / 250).scale(0));
  }
  const Sky row(sky_texels(3, 1, std::vector<float>{1, 1, 1, 2, 2, 2, 3, 3, 3}));
  CHECK(row.towards({1, 0, 0}).radiance == Color{2, 2, 2});
  CHECK(row.towards(direction_of(0.1, 0)).radiance == Color{2, 2, 2});
  const Sky column(sky_texels(1, 2, std::vector<float>{1, 1, 1, 3, 3, 3}));
  CHECK(column.towards({0, 1, 0}).radiance.x == doctest::Approx(2));
  CHECK(column.towards({0, 0, 1}).radiance.x == 1);
}

TEST_CASE("the strength of a texel is that of its colour, exactly") {
  for (std::uint64_t key = 0; key < 10'000; ++key) {
    const auto texel = static_cast<std::uint32_t>(mix(key + 1));
    CHECK(sum_of_channels(texel) == strength_of(decoded(TexelFormat::shared_exponent, texel)));
  }
}

TEST_CASE("cells are all directions, once each, and chances to draw them add up to 1") {
  for (const std::uint32_t width : {2U, 8U, 14U, 60U, 256U}) {
    CAPTURE(width);
    const Sky sky(sunny_texels(width, 5));
    double angle = 0, weight = 0;
    for (std::uint32_t tile = 0; tile < sky.records.tiles.size(); ++tile) {
      const SkyCells cells(sky.reference(), tile, sky.tile(tile));
      angle += cells.solid_angle();
      weight += cells.all();
    }
    CHECK(angle == doctest::Approx(4 * pi).epsilon(1e-12).scale(0));
    CHECK(weight * double{sky.reference().density} == doctest::Approx(1).epsilon(1e-6).scale(0));
    CHECK(sky.records.tiles.size() == sky_tile_count(sky.reference()));
  }
}

TEST_CASE("the density of directions is 1 over all of them by quadrature") {
  const Sky sky(sunny_texels(60));
  constexpr int steps = 1200;
  double sum = 0;
  for (int row = 0; row < steps; ++row) {
    const double angle = pi * (row + 0.5) / steps;
    for (int column = 0; column < steps; ++column) {
      sum += sky.towards(direction_of(angle, 2 * pi * (column + 0.5) / steps)).density * std::sin(angle);
    }
  }
  CHECK(sum * 2 * pi * pi / steps / steps == doctest::Approx(1).epsilon(1e-4).scale(0));
}

TEST_CASE("what is drawn is as likely as its density says: chi-square of 2 * 10^5 draws in 64x32 boxes") {
  const Sky sky(sunny_texels(60, 20));
  constexpr int columns = 64, rows = 32, draws = 200'000, fine = 24;
  std::vector<double> expected(columns * rows), found(columns * rows);
  for (int row = 0; row < rows * fine; ++row) {
    for (int column = 0; column < columns * fine; ++column) {
      const double height = 1 - 2 * (row + 0.5) / (rows * fine), left = 2 * pi * (column + 0.5) / (columns * fine);
      expected[static_cast<std::size_t>(row / fine * columns + column / fine)] +=
          sky.towards(direction_of(std::acos(height), left)).density * 4 * pi / (rows * columns * fine * fine) * draws;
    }
  }
  for (std::uint64_t i = 0; i < draws; ++i) {
    const SkyCells::Drawn drawn = sky.draw(i);
    REQUIRE(std::fabs(length(drawn.towards) - 1) < 1e-12);
    const double left = std::atan2(drawn.towards.y, drawn.towards.x);
    const int column = std::min(static_cast<int>((left < 0 ? left + 2 * pi : left) / (2 * pi) * columns), columns - 1);
    const int row = std::clamp(static_cast<int>((1 - drawn.towards.z) / 2 * rows), 0, rows - 1);
    ++found[static_cast<std::size_t>(row * columns + column)];
  }
  double sum = 0;
  int boxes = 0;
  for (std::size_t box = 0; box < found.size(); ++box) {
    if (expected[box] > 5) {
      sum += (found[box] - expected[box]) * (found[box] - expected[box]) / expected[box];
      ++boxes;
    }
  }
  REQUIRE(boxes > 1500);
  CHECK(sum < boxes + 3.9 * std::sqrt(2.0 * boxes));  // more is less likely than 10^-4
  CHECK(sum > boxes - 3.9 * std::sqrt(2.0 * boxes));
}

TEST_CASE("who draws a place, and who meets it, see the same light there with the same density") {
  for (const std::uint32_t width : {2U, 14U, 60U, 500U}) {
    const Sky sky(sunny_texels(width));
    int beside = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const SkyCells::Drawn drawn = sky.draw(i);
      const SkyPlace met = sky_place(sky.reference(), drawn.towards);
      const bool is_same = met.tile == drawn.place.tile && met.column == drawn.place.column && met.row == drawn.place.row;
      beside += is_same ? 0 : 1;  // on an edge, by rounding
      if (is_same) {
        CHECK(std::fabs(met.across - drawn.place.across) < 1e-7);
        CHECK(std::fabs(met.down - drawn.place.down) < 1e-7);
        const SkyLight aimed = sky_light(sky.reference(), sky.tile(drawn.place.tile), drawn.place);
        CHECK(aimed.density == doctest::Approx(sky.towards(drawn.towards).density).epsilon(1e-6).scale(0));
      }
    }
    CHECK(beside < 3);
  }
}

TEST_CASE("under a sun of one texel in a dim sky, 64 stratified samples find a floor's light to 2 %, whatever scrambles them") {
  const std::vector<double> by_sample = [] {
    const Sky sky(one_bright_texel(512, 100, 40, 60000, 0.5F));
    std::vector<double> means;
    for (std::uint64_t pixel = 0; pixel < 40; ++pixel) {
      double sum = 0;
      for (int i = 0; i < 64; ++i) {
        const SamplePair pair = sample_pair(static_cast<std::uint32_t>(pixel), static_cast<std::uint32_t>(i), 3);
        const SkyCells::Drawn drawn = sky.draw(pair.x, pair.y);
        const SkyLight light = sky_light(sky.reference(), sky.tile(drawn.place.tile), drawn.place);
        sum += double{light.radiance.x} * std::max(drawn.towards.z, 0.0) / light.density / 64;
      }
      means.push_back(sum);
    }
    return means;
  }();
  const double mean = std::accumulate(by_sample.begin(), by_sample.end(), 0.0) / static_cast<double>(by_sample.size());
  double square = 0;
  for (const double each : by_sample) {
    square += (each / mean - 1) * (each / mean - 1) / static_cast<double>(by_sample.size());
  }
  CHECK(std::sqrt(square) < 0.02);
}

TEST_CASE("black places are drawn next to never, and have a density all the same") {
  const Sky sky(one_bright_texel(32, 20, 4, 1000, 0));
  int dark = 0;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    const SkyCells::Drawn drawn = sky.draw(i);
    dark += sky_light(sky.reference(), sky.tile(drawn.place.tile), drawn.place).radiance.x > 0 ? 0 : 1;
  }
  CHECK(dark < 3);
  CHECK(sky.towards({0, 0, -1}).density > 0);
  CHECK(sky.towards({0, 0, -1}).radiance == Color{});
}

}  // namespace sky_cells_test
