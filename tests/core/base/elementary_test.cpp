#include "core/base/elementary.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>

#include "core/base/expect.h"

namespace elementary_test {

using namespace dmpc::core;

namespace {

constexpr int trials = 200'000;

/// The largest relative error of `ours` against libm in extended precision over [low, high].
template <class Ours, class Theirs>
double worst_relative(double low, double high, Ours ours, Theirs theirs) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> range(low, high);
  long double worst = 0;
  for (int i = 0; i < trials; ++i) {
    const double x = range(random);
    const long double expected = theirs(static_cast<long double>(x));
    worst = std::max(worst, std::abs((static_cast<long double>(ours(x)) - expected) / expected));
  }
  return static_cast<double>(worst);
}

double read_back(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%g", value);
  return std::strtod(text, nullptr);
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

}  // namespace

TEST_CASE("sine, cosine and tangent of radians keep their stated errors") {
  for (const double reach : {0.8, 7.0, 60.0, 1e6}) {
    CAPTURE(reach);
    CHECK(worst_relative(-reach, reach, sin_radians, [](long double x) { return std::sin(x); }) < 4e-16);
    CHECK(worst_relative(-reach, reach, cos_radians, [](long double x) { return std::cos(x); }) < 4e-16);
    CHECK(worst_relative(-reach, reach, tan_radians, [](long double x) { return std::tan(x); }) < 1e-15);
  }
}

TEST_CASE("the angle to a place keeps its stated error all round, and axes and diagonals have theirs") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> range(-1, 1);
  long double worst = 0;
  for (int i = 0; i < trials; ++i) {
    const double x = range(random), y = range(random) * (i % 2 == 0 ? 1 : 1e-9);
    worst = std::max(worst, std::abs(static_cast<long double>(angle_of(y, x)) - std::atan2(static_cast<long double>(y), x)));
  }
  CHECK(worst < 5e-16L);
  constexpr double pi = std::numbers::pi;
  CHECK(angle_of(0, 1) == 0);
  CHECK(angle_of(1, 0) == pi / 2);
  CHECK(angle_of(0, -1) == pi);
  CHECK(angle_of(-2, 0) == -pi / 2);
  CHECK(angle_of(3, 3) == pi / 4);
  CHECK(angle_of(-3, -3) == -3 * pi / 4);
  CHECK(angle_of(0, 0) == 0);
  CHECK(angle_of(1e-300, 1e300) >= 0);
}

TEST_CASE("sine and tangent are their argument near zero, and the sign of zero stays") {
  CHECK(sin_radians(1e-300) == 1e-300);
  CHECK(tan_radians(-1e-9) == doctest::Approx(-1e-9).epsilon(1e-15));
  CHECK(same_bits(sin_radians(0.0), 0.0));
  CHECK(cos_radians(0.0) == 1);
}

TEST_CASE("sine and cosine of degrees keep their stated errors") {
  constexpr long double degree = std::numbers::pi_v<long double> / 180;
  CHECK(worst_relative(-45, 45, sin_degrees, [](long double x) { return std::sin(x * degree); }) < 4e-16);
  CHECK(worst_relative(-45, 45, cos_degrees, [](long double x) { return std::cos(x * degree); }) < 4e-16);
  CHECK(worst_relative(1, 89, tan_degrees, [](long double x) { return std::tan(x * degree); }) < 1e-15);
  CHECK(worst_relative(0.001, 179.9, sin_degrees, [](long double x) { return std::sin(x * degree); }) < 1e-15);
}

TEST_CASE("sine and cosine of degrees are exact where they are 0, a half or 1") {
  const double sines[12] = {0, 0.5, 2, 1, 2, 0.5, 0, -0.5, 2, -1, 2, -0.5};  // at multiples of 30; 2: not rational
  for (int i = -36; i <= 36; ++i) {
    const double sine = sines[((i % 12) + 12) % 12];
    CAPTURE(i);
    if (sine != 2) {
      CHECK(sin_degrees(30 * i) == sine);
      CHECK(cos_degrees(30 * i - 90) == sine);
    }
  }
  CHECK(same_bits(sin_degrees(180), 0.0));
  CHECK(same_bits(cos_degrees(90), 0.0));
}

TEST_CASE("an angle that is too large or not a number is refused") {
  CHECK_THROWS_AS(sin_radians(1.1e6), InternalError);
  CHECK_THROWS_AS(cos_degrees(std::numeric_limits<double>::infinity()), InternalError);
  CHECK_THROWS_AS(sin_degrees(std::numeric_limits<double>::quiet_NaN()), InternalError);
}

TEST_CASE("the exponential keeps its stated error") {
  CHECK(worst_relative(-1, 1, exponential, [](long double x) { return std::exp(x); }) < 4e-16);
  CHECK(worst_relative(-708, 709.7, exponential, [](long double x) { return std::exp(x); }) < 4e-16);
  CHECK(exponential(0) == 1);
  CHECK(exponential(-746) == 0);
  CHECK(exponential(710) == std::numeric_limits<double>::infinity());
  CHECK(exponential(-740) == doctest::Approx(std::exp(-740.0)));
  CHECK(std::isnan(exponential(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("the natural logarithm keeps its stated error") {
  CHECK(worst_relative(0.5, 2, natural_log, [](long double x) { return std::log(x); }) < 7e-16);
  CHECK(worst_relative(1e-300, 1e-5, natural_log, [](long double x) { return std::log(x); }) < 7e-16);
  CHECK(worst_relative(2, 1e300, natural_log, [](long double x) { return std::log(x); }) < 7e-16);
  CHECK(same_bits(natural_log(1), 0.0));
  CHECK(natural_log(5e-324) == doctest::Approx(std::log(5e-324)));
  CHECK(natural_log(0) == -std::numeric_limits<double>::infinity());
  CHECK(std::isnan(natural_log(-1)));
}

TEST_CASE("a power of a number between 0 and 1 keeps its stated error") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0;
  for (int i = 0; i < trials; ++i) {
    const double exponent = 3 / (unit(random) + 1e-5) - 2;
    const double base = i % 2 == 0 ? unit(random) : 1 - unit(random) / (exponent + 3);
    const double power = pow_unit(base, exponent);
    const long double expected = std::pow(static_cast<long double>(base), static_cast<long double>(exponent));
    worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(power) - expected)));
  }
  CHECK(worst < 6e-16);
}

TEST_CASE("a power at the ends of its range is 0 or 1") {
  CHECK(pow_unit(0, 0) == 1);
  CHECK(pow_unit(0.3, 0) == 1);
  CHECK(pow_unit(0, 5) == 0);
  CHECK(pow_unit(1, 100000) == 1);
  CHECK(pow_unit(0.5, 1) == 0.5);
  CHECK(pow_unit(0.9, 100000) == 0);
  CHECK(pow_unit(1.0000000001, 100000) == 1);
  CHECK(pow_unit(1 + 0x1p-52, 1e33) == 1);
  CHECK(pow_unit(-0.1, 3) == 0);
}

TEST_CASE("rounding to 6 digits is what reading the printed number gives") {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::uint64_t> bits;
  std::uniform_real_distribution<double> near(-20, 20);
  int different = 0;
  for (int i = 0; i < trials; ++i) {
    const double any = std::bit_cast<double>(bits(random));
    const double usual = near(random);
    different += std::isfinite(any) && !same_bits(round_to_6_digits(any), read_back(any)) ? 1 : 0;
    different += same_bits(round_to_6_digits(usual), read_back(usual)) ? 0 : 1;
  }
  CHECK(different == 0);
}

TEST_CASE("rounding to 6 digits settles ties and neighbours of powers of ten as printing does") {
  int different = 0;
  for (int exponent = -22; exponent <= 27; ++exponent) {
    for (const double factor : {1.0, 9.999995, 9.9999949999, 9.9999950001, 1.000005, 1.000015, 4.194305, 7.8125, 1.5}) {
      const double value = factor * std::pow(10.0, exponent);
      for (const double x : {value, -value, std::nextafter(value, 0.0), std::nextafter(value, 1e300)}) {
        different += same_bits(round_to_6_digits(x), read_back(x)) ? 0 : 1;
      }
    }
  }
  for (int i = 1; i < 2'000'000; i += 2) {
    const double tie = i / 128.0;  // 7 binary digits behind the point: many have a 5 as the last of 7 digits
    different += same_bits(round_to_6_digits(tie), read_back(tie)) ? 0 : 1;
    i += i > 200'000 ? 1998 : 0;
  }
  CHECK(different == 0);
}

TEST_CASE("rounding to 6 digits keeps zeros and what is not finite") {
  CHECK(same_bits(round_to_6_digits(-0.0), -0.0));
  CHECK(same_bits(round_to_6_digits(0.0), 0.0));
  CHECK(round_to_6_digits(-std::numeric_limits<double>::infinity()) == -std::numeric_limits<double>::infinity());
  CHECK(std::isnan(round_to_6_digits(std::numeric_limits<double>::quiet_NaN())));
  CHECK(round_to_6_digits(5e-324) == 5e-324);
}

}  // namespace elementary_test
