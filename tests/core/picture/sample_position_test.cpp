#include "core/picture/sample_position.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <utility>

namespace sample_position_test {

using namespace dmpc::core;

namespace {

std::uint32_t cell(double coordinate, int cells_log2) { return static_cast<std::uint32_t>(std::ldexp(coordinate, cells_log2)); }

/// Whether 2^k samples from `first` on lie one in each of 2^k boxes, 2^i to a side by 2^(k - i).
bool fills_boxes(std::uint32_t pixel, std::uint32_t first, int k, int i) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> boxes;
  for (std::uint32_t index = 0; index < 1U << k; ++index) {
    const SamplePosition position = sample_position(pixel, first + index);
    boxes.insert({cell(position.x, i), cell(position.y, k - i)});
  }
  return boxes.size() == std::size_t{1} << k;
}

/// The mean square error of `samples` samples of a pixel on whose left side, up to anywhere, there is light of 1.
double edge_error(std::uint32_t samples) {
  constexpr std::uint32_t pixels = 20'000;
  double sum = 0;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    const double edge = (pixel * 0.6180339887498949) - std::floor(pixel * 0.6180339887498949);
    double lit = 0;
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
      lit += sample_position(pixel, sample).x < edge ? 1 : 0;
    }
    sum += (lit / samples - edge) * (lit / samples - edge);
  }
  return sum / pixels;
}

}  // namespace

TEST_CASE("of the first 2^k samples each lies in a box of its own, however the pixel is cut into 2^k") {
  for (std::uint32_t pixel = 0; pixel < 20; ++pixel) {
    for (int k = 0; k <= 9; ++k) {
      for (int i = 0; i <= k; ++i) {
        REQUIRE(fills_boxes(pixel, 0, k, i));
      }
    }
  }
}

TEST_CASE("each block of 2^k samples, as passes add them, fills the boxes as the first 2^k do") {
  for (std::uint32_t pixel = 0; pixel < 20; ++pixel) {
    for (int k = 0; k <= 6; ++k) {
      for (int i = 0; i <= k; ++i) {
        REQUIRE(fills_boxes(pixel, 1U << k, k, i));
        REQUIRE(fills_boxes(pixel, 3U << k, k, i));
      }
    }
  }
}

TEST_CASE("an upright edge is off by what one of n equal strips can be off: the mean square is 1 / (6 n^2)") {
  for (const std::uint32_t samples : {1U, 2U, 4U, 8U, 16U}) {
    CAPTURE(samples);
    CHECK(edge_error(samples) == doctest::Approx(1.0 / (6.0 * samples * samples)).epsilon(0.05));
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

TEST_CASE("the samples of a pixel do not follow those of another, nor their columns their rows") {
  double pixels = 0, axes = 0;
  for (std::uint32_t pixel = 0; pixel < 10'000; ++pixel) {
    const SamplePosition first = sample_position(pixel, 0);
    pixels += (first.x - 0.5) * (sample_position(pixel + 1, 0).x - 0.5);
    axes += (sample_position(pixel, 1).x - 0.5) * (sample_position(pixel, 2).y - 0.5);
  }
  CHECK(std::fabs(pixels / 10'000) < 0.003);
  CHECK(std::fabs(axes / 10'000) < 0.003);
}

TEST_CASE("the same pixel and sample always lie at the same place") {
  CHECK(sample_position(7, 3) == sample_position(7, 3));
  CHECK(sample_position(0xffffffff, 0xffffffff).x < 1);
}

}  // namespace sample_position_test
