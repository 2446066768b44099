#include "core/picture/sample_position.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <utility>

namespace sample_position_test {

using namespace dmpc::core;

namespace {

std::uint32_t cell(double coordinate, int cells_log2) { return static_cast<std::uint32_t>(std::ldexp(coordinate, cells_log2)); }

/// Whether the first 2^k samples of a plane lie one in each of 2^k boxes, 2^i to a side by 2^(k - i).
bool fills_boxes(std::uint32_t pixel, std::uint32_t plane, int k, int i) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> boxes;
  for (std::uint32_t index = 0; index < 1U << k; ++index) {
    const SamplePosition position = sample_position(pixel, 2 * index + plane);
    boxes.insert({cell(position.x, i), cell(position.y, k - i)});
  }
  return boxes.size() == std::size_t{1} << k;
}

}  // namespace

TEST_CASE("of the first 2^k samples of a plane each lies in a box of its own, however the pixel is cut into 2^k") {
  for (std::uint32_t pixel = 0; pixel < 20; ++pixel) {
    for (int k = 0; k <= 9; ++k) {
      for (int i = 0; i <= k; ++i) {
        REQUIRE(fills_boxes(pixel, 0, k, i));
        REQUIRE(fills_boxes(pixel, 1, k, i));
      }
    }
  }
}

TEST_CASE("samples lie in their pixel, each position equally likely") {
  double sum_x = 0, sum_y = 0, product = 0;
  int bins[10] = {};
  for (std::uint32_t pixel = 0; pixel < 10'000; ++pixel) {
    const SamplePosition position = sample_position(pixel, 0);
    REQUIRE((position.x >= 0 && position.x < 1 && position.y >= 0 && position.y < 1));
    sum_x += position.x;
    sum_y += position.y;
    product += (position.x - 0.5) * (position.y - 0.5);
    ++bins[static_cast<int>(position.x * 10)];
  }
  CHECK(sum_x / 10'000 == doctest::Approx(0.5).epsilon(0.02));
  CHECK(sum_y / 10'000 == doctest::Approx(0.5).epsilon(0.02));
  CHECK(std::fabs(product / 10'000) < 0.005);
  for (const int bin : bins) {
    CHECK(std::abs(bin - 1000) < 150);
  }
}

TEST_CASE("even and odd samples, and different pixels, do not follow each other") {
  double planes = 0, pixels = 0;
  for (std::uint32_t pixel = 0; pixel < 10'000; ++pixel) {
    const double even = sample_position(pixel, 0).x - 0.5;
    planes += even * (sample_position(pixel, 1).x - 0.5);
    pixels += even * (sample_position(pixel + 1, 0).x - 0.5);
  }
  CHECK(std::fabs(planes / 10'000) < 0.003);
  CHECK(std::fabs(pixels / 10'000) < 0.003);
}

TEST_CASE("the same pixel and sample always lie at the same place") {
  CHECK(sample_position(7, 3) == sample_position(7, 3));
  CHECK(sample_position(0xffffffff, 0xffffffff).x < 1);
}

}  // namespace sample_position_test
