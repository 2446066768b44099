#include "core/sampling.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace dmpc::core;

TEST_CASE("sample values are at least 0 and below 1, and are spread evenly") {
  double sum = 0;
  int bins[10] = {};
  for (std::uint32_t pixel = 0; pixel < 100; ++pixel) {
    for (std::uint32_t sample = 0; sample < 100; ++sample) {
      const double value = sample_value(pixel, sample, 0);
      REQUIRE(value >= 0);
      REQUIRE(value < 1);
      sum += value;
      ++bins[static_cast<int>(value * 10)];
    }
  }
  CHECK(sum / 10'000 == doctest::Approx(0.5).epsilon(0.02));
  for (const int bin : bins) {
    CHECK(std::abs(bin - 1000) < 150);
  }
}

TEST_CASE("pixels, samples and dimensions give values of their own") {
  std::set<double> values;
  for (std::uint32_t i = 0; i < 16; ++i) {
    for (std::uint32_t j = 0; j < 16; ++j) {
      for (std::uint32_t dimension = 0; dimension < 4; ++dimension) {
        values.insert(sample_value(i, j, dimension));
      }
    }
  }
  CHECK(values.size() == 16 * 16 * 4);
}

TEST_CASE("dimensions do not follow each other") {
  double product = 0;
  for (std::uint32_t sample = 0; sample < 10'000; ++sample) {
    product += (sample_value(7, sample, 0) - 0.5) * (sample_value(7, sample, 1) - 0.5);
  }
  CHECK(std::fabs(product / 10'000) < 0.005);
}
