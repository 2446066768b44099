#include "core/picture/sampling/sample_pair.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <set>
#include <utility>

namespace sample_pair_test {

using namespace dmpc::core;

namespace {

std::uint32_t cell(double coordinate, int cells_log2) { return static_cast<std::uint32_t>(std::ldexp(coordinate, cells_log2)); }

/// Whether 2^k samples from `first` on lie one in each of 2^k boxes, 2^i to a side by 2^(k - i).
bool fills_boxes(std::uint32_t pixel, std::uint32_t pair, std::uint32_t first, int k, int i) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> boxes;
  for (std::uint32_t index = 0; index < 1U << k; ++index) {
    const SamplePair numbers = sample_pair(pixel, first + index, pair);
    boxes.insert({cell(numbers.x, i), cell(numbers.y, k - i)});
  }
  return boxes.size() == std::size_t{1} << k;
}

/// The root mean square, over pixels, of the mean of a product of numbers of two pairs, less 1/2 each, over so many samples.
double bond(std::uint32_t pair, std::uint32_t other, std::uint32_t samples) {
  constexpr std::uint32_t pixels = 200;
  double squares = 0;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    double sum = 0;
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
      sum += (sample_pair(pixel, sample, pair).x - 0.5) * (sample_pair(pixel, sample, other).x - 0.5);
    }
    squares += sum / samples * (sum / samples);
  }
  return std::sqrt(squares / pixels);
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

TEST_CASE("the pair of a place in the pixel has the bits that it had when it was the only one") {
  CHECK(sample_pair(7, 3, 0) == sample_position(7, 3));
  CHECK(sample_pair(0, 0, 0) == SamplePair{3612750254 * 0x1p-32, 3139362225 * 0x1p-32});
  CHECK(sample_pair(7, 3, 0) == SamplePair{2760278411 * 0x1p-32, 2096723593 * 0x1p-32});
  CHECK(sample_pair(123456, 77, 0) == SamplePair{3593994644 * 0x1p-32, 4170297460 * 0x1p-32});
  CHECK(sample_position(0xffffffff, 0xffffffff).x < 1);
}

TEST_CASE("aligned leaves of 2^k samples fill the boxes in every pair, as passes add them") {
  for (const std::uint32_t pair : {0U, 1U, 2U, 3U, 5U, 1020U}) {
    for (std::uint32_t pixel = 0; pixel < 5; ++pixel) {
      for (int k = 0; k <= 8; ++k) {
        for (int i = 0; i <= k; ++i) {
          REQUIRE(fills_boxes(pixel, pair, 0, k, i));
          REQUIRE(fills_boxes(pixel, pair, 1U << k, k, i));
          REQUIRE(fills_boxes(pixel, pair, 3U << k, k, i));
        }
      }
    }
  }
}

// An order that keeps leaves together pairs neighbours alike, so what two pairs share is up to the root of 2 more than by chance.
TEST_CASE("pairs of a sample have nothing to do with each other: what they share falls as of numbers drawn by chance") {
  for (const std::uint32_t samples : {64U, 1024U}) {
    const double by_chance = 1 / (12 * std::sqrt(static_cast<double>(samples)));
    CAPTURE(samples);
    CHECK(bond(1, 2, samples) < 1.6 * by_chance);
    CHECK(bond(0, 2, samples) < 1.6 * by_chance);
    CHECK(bond(2, 6, samples) < 1.6 * by_chance);
  }
}

TEST_CASE("in each pair every place is equally likely") {
  for (const std::uint32_t pair : {0U, 1U, 2U, 77U}) {
    double sum_x = 0, sum_y = 0, product = 0;
    int bins[10] = {};
    for (std::uint32_t pixel = 0; pixel < 10'000; ++pixel) {
      const SamplePair numbers = sample_pair(pixel, 0, pair);
      REQUIRE((numbers.x >= 0 && numbers.x < 1 && numbers.y >= 0 && numbers.y < 1));
      sum_x += numbers.x;
      sum_y += numbers.y;
      product += (numbers.x - 0.5) * (numbers.y - 0.5);
      ++bins[static_cast<int>(numbers.x * 10)];
    }
    for (const int bin : bins) {
      CHECK(std::abs(bin - 1000) < 150);
    }
    CHECK(std::fabs(sum_x / 10'000 - 0.5) < 0.012);
    CHECK(std::fabs(sum_y / 10'000 - 0.5) < 0.012);
    CHECK(std::fabs(product / 10'000) < 0.0034);
  }
}

TEST_CASE("an upright edge is off by what one of n equal strips can be off: the mean square is 1 / (6 n^2)") {
  for (const std::uint32_t samples : {1U, 2U, 4U, 8U, 16U}) {
    CAPTURE(samples);
    CHECK(edge_error(samples) == doctest::Approx(1.0 / (6.0 * samples * samples)).epsilon(0.05));
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

}  // namespace sample_pair_test
