#include "core/record/curved_values.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "apps/lab/bench/stability/random.h"

namespace curved_values_test {

using namespace dmpc::core;
using dmpc::apps::Random;

namespace {

double through_float(double value) {
  const auto rounded = static_cast<float>(value);
  return with_rest(rounded, rest_of(value, rounded));
}

}  // namespace

TEST_CASE("a float and its rest are a value to 2^-31 of it") {
  Random random(1);
  for (int i = 0; i < 10'000; ++i) {
    const double value = random.between(-1, 1) * std::pow(10.0, random.between(-30, 30));
    REQUIRE(std::fabs(through_float(value) - value) <= 0x1p-31 * std::fabs(value));
  }
}

TEST_CASE("a value that a float holds has no rest") {
  for (const float value : {0.0F, -0.0F, 1.0F, -1.5F, 0x1p-140F, 1e30F}) {
    CHECK(rest_of(double{value}, value) == 0);
    CHECK(with_rest(value, 0) == double{value});
  }
}

TEST_CASE("what is not finite has no rest") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {infinity, -infinity, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK(rest_of(value, static_cast<float>(value)) == 0);
  }
}

TEST_CASE("a value scaled by a power of two has the same rest") {
  for (const double value : {0.1, -1.0 / 3, 123.456, 7e-9}) {
    const double scaled = value * 0x1p20;
    CHECK(rest_of(scaled, static_cast<float>(scaled)) == rest_of(value, static_cast<float>(value)));
  }
}

TEST_CASE("of what passes by local zero a coordinate is exact to 2^-28, a radius to 2^-44") {
  Random random(2);
  for (int i = 0; i < 10'000; ++i) {
    const std::array<double, 4> values{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1),
                                       random.between(-1, 1)};
    std::array<float, 4> rounded{};
    std::transform(values.begin(), values.end(), rounded.begin(), [](double value) { return static_cast<float>(value); });
    const std::uint32_t rests = passing_rests_of(values, rounded.data());
    for (std::size_t k = 0; k < 4; ++k) {
      const double off = std::fabs(with_passing_rest(rounded[k], rests, k) - values[k]);
      REQUIRE(off <= (k < 3 ? 0x1p-27 : 0x1p-43) * std::fabs(values[k]));
    }
  }
}

TEST_CASE("four values at once are those one by one, whichever way their rests are told") {
  Random random(3);
  for (const bool passes_by : {false, true}) {
    const auto radius = static_cast<float>(random.between(0.3, 0.4));
    std::array<float, 5> rows{0.003F, -0.002F, passes_by ? -radius * 1.001F : 0.1F, radius, std::bit_cast<float>(0x12f38177U)};
    const CurvedValues sphere(PrimitiveKind::sphere, rows.data(), 1, 0);
    CHECK(sphere.passes_by() == passes_by);
    CHECK(sphere.four(0).place == sphere.vector(0));
    CHECK(sphere.four(0).radius == sphere.value(3));
  }
}

TEST_CASE("a lane's values are its floats and the bytes of its rests") {
  constexpr std::size_t lanes = 3, lane = 1;
  std::array<float, 10 * lanes> rows{};
  for (std::size_t row = 0; row < 8; ++row) {
    rows[row * lanes + lane] = static_cast<float>(row + 1);
  }
  rows[8 * lanes + lane] = std::bit_cast<float>(std::uint32_t{0x0403ff80});  // -128, -1, 3, 4
  rows[9 * lanes + lane] = std::bit_cast<float>(std::uint32_t{0x7f000000});  // 0, 0, 0, 127
  const CurvedValues cone(PrimitiveKind::cone, rows.data(), lanes, lane);
  const auto rest = [&](std::size_t row) {
    const double value = static_cast<double>(row + 1);
    return (cone.value(row) - value) / (std::exp2(std::floor(std::log2(value))) * 0x1p-31);
  };
  CHECK(rest(0) == -128);
  CHECK(rest(1) == -1);
  CHECK(rest(2) == 3);
  CHECK(rest(3) == 4);
  CHECK(rest(6) == 0);
  CHECK(rest(7) == 127);
  CHECK(cone.vector(4).x == 5);
}

}  // namespace curved_values_test
