// The exponential, the logarithm and powers without calls and branches, so that compilers vectorise loops over them; the results
// have the same bits as those for single numbers. core/base/elementary.h states the errors.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace dmpc::core {

// Each constant is the nearest double and, where it matters, the nearest double to the remainder.
inline constexpr double log_2 = 0x1.62e42fefa39efp-1, log_2_tail = 0x1.abc9e3b39803fp-56;
inline constexpr double one_over_log_2 = 0x1.71547652b82fep+0;

/// Below this exponent the exponential is 0.
inline constexpr double least_exponent = -745.2;

/// The sum of every second term, from coefficient `Last` up to the highest power.
template <std::size_t Last, std::size_t Count>
double every_second(double square, const std::array<double, Count>& coefficients) {
  if constexpr (Last < 2) {
    return coefficients[Last];
  } else {
    return std::fma(every_second<Last - 2>(square, coefficients), square, coefficients[Last]);
  }
}

/// A polynomial as two independent sums, with coefficients from the highest power down.
template <std::size_t Count>
double polynomial_in_halves(double x, const std::array<double, Count>& coefficients) {
  const double square = x * x;
  return std::fma(every_second<Count - 2>(square, coefficients), x, every_second<Count - 1>(square, coefficients));
}

/// 2 ^ exponent; requires -1022 <= exponent <= 1023.
inline double power_of_2(int exponent) { return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52U); }

/// value * 2 ^ exponent for |exponent| <= 1100, rounded once if the result is not normal.
inline double scaled_by_2(double value, int exponent) {
  const int first = exponent / 2;
  return value * power_of_2(first) * power_of_2(exponent - first);
}

/// The exponential of |x| up to log(2)/2, by Taylor's series to the 14th power; the first omitted term is below 1e-19.
inline double exponential_reduced(double x) {
  constexpr std::array<double, 13> series = {1 / 87178291200.0, 1 / 6227020800.0, 1 / 479001600.0, 1 / 39916800.0, 1 / 3628800.0,
                                             1 / 362880.0,      1 / 40320.0,      1 / 5040.0,      1 / 720.0,      1 / 120.0,
                                             1 / 24.0,          1 / 6.0,          1 / 2.0};
  return 1 + std::fma(x * x, polynomial_in_halves(x, series), x);
}

/// e to the power x for |x| <= 746, beyond which no double can hold the result.
inline double finite_exponential(double x) {
  const double count = std::nearbyint(x * one_over_log_2);
  const double rest = std::fma(-count, log_2_tail, std::fma(-count, log_2, x));
  return scaled_by_2(exponential_reduced(rest), static_cast<int>(count));
}

/// value = significand * 2 ^ exponent, with the significand approximately in [sqrt(1/2), sqrt(2)).
struct Binary {
  double significand = 1;
  int exponent = 0;
};

inline Binary in_binary(double value) {
  const bool tiny = value < std::numeric_limits<double>::min();
  const auto bits = std::bit_cast<std::uint64_t>(tiny ? value * 0x1p54 : value);
  const int exponent = static_cast<int>(bits >> 52U) - 1023 - (tiny ? 54 : 0);
  const double significand = std::bit_cast<double>((bits & 0xfffffffffffffU) | (std::uint64_t{1023} << 52U));
  const bool large = significand > 0x1.6a09ep+0;
  return {large ? significand / 2 : significand, large ? exponent + 1 : exponent};
}

/// log(significand) = 2 artanh(s) with s = (significand - 1) / (significand + 1), |s| < 0.1716. The first omitted term of the
/// series, s^23, is below 2e-18 relative to the first.
inline double log_reduced(double significand) {
  constexpr std::array<double, 10> series = {2 / 21.0, 2 / 19.0, 2 / 17.0, 2 / 15.0, 2 / 13.0,
                                             2 / 11.0, 2 / 9.0,  2 / 7.0,  2 / 5.0,  2 / 3.0};
  const double offset = significand - 1;
  const double s = offset / (significand + 1);
  const double square = s * s;
  // 2 s = offset - s offset, which keeps the leading term exact.
  return offset - s * (offset - square * polynomial_in_halves(square, series));
}

/// The natural logarithm of a positive number; for any other number the result is unspecified.
inline double finite_log(double x) {
  const Binary parts = in_binary(x);
  const double count = parts.exponent;
  const double high = count * log_2;
  const double low = std::fma(count, log_2, -high) + count * log_2_tail;
  return high + (log_reduced(parts.significand) + low);
}

/// base ^ exponent for 0 <= base <= 1 and exponent >= 0. A base outside [0, 1] is clamped.
inline double unit_power(double base, double exponent) {
  constexpr double surely_0 = -746;  // its exponential rounds to 0
  const double power = finite_exponential(std::min(0.0, std::max(surely_0, exponent * finite_log(base))));
  const double inside = base > 0 ? power : 0.0, capped = base >= 1 ? 1.0 : inside;
  return exponent == 0 ? 1.0 : capped;
}

}  // namespace dmpc::core
