#include "core/base/elementary.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/base/expect.h"
#include "core/base/exponents.h"

namespace dmpc::core {
namespace {

// Each constant is the nearest double and, where it matters, the nearest double to the remainder.
constexpr double half_pi = 0x1.921fb54442d18p+0, half_pi_tail = 0x1.1a62633145c07p-54;
constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
constexpr double radian_per_degree = 0x1.1df46a2529d39p-6, radian_per_degree_tail = 0x1.5c1d8becdd291p-62;

constexpr double angle_max = 1e6;

/// The number of quarter turns, and the rest of the angle in radians as an unevaluated sum, |high| slightly above pi/4 at most.
struct Reduced {
  int quarter = 0;
  double high = 0, low = 0;
};

Reduced renormalized(double quarters, double high, double low) {
  const double sum = high + low;
  return {static_cast<int>(static_cast<std::int64_t>(quarters) & 3), sum, (high - sum) + low};
}

Reduced reduce_radians(double radians) {
  expect(std::abs(radians) <= angle_max, "an angle lies within a million radians");
  const double quarters = std::nearbyint(radians * two_over_pi);
  return renormalized(quarters, std::fma(-quarters, half_pi, radians), -quarters * half_pi_tail);
}

/// Horner's rule; coefficients from the highest power down.
template <std::size_t Count>
double polynomial(double x, const std::array<double, Count>& coefficients) {
  double sum = coefficients[0];
  for (std::size_t i = 1; i < Count; ++i) {
    sum = std::fma(sum, x, coefficients[i]);
  }
  return sum;
}

/// Taylor's series to the 17th power: the first omitted term is below 1e-19 at pi/4.
double sin_reduced(double high, double low) {
  static constexpr std::array<double, 8> series = {1 / 355687428096000.0, -1 / 1307674368000.0, 1 / 6227020800.0, -1 / 39916800.0,
                                                   1 / 362880.0,          -1 / 5040.0,          1 / 120.0,        -1 / 6.0};
  const double square = high * high;
  return high + std::fma(high * square, polynomial(square, series), std::fma(-0.5 * square, low, low));
}

/// Taylor's series to the 18th power: the first omitted term is below 4e-21 at pi/4.
double cos_reduced(double high, double low) {
  static constexpr std::array<double, 8> series = {
      -1 / 6402373705728000.0, 1 / 20922789888000.0, -1 / 87178291200.0, 1 / 479001600.0,
      -1 / 3628800.0,          1 / 40320.0,          -1 / 720.0,         1 / 24.0};
  const double square = high * high;
  const double half = 0.5 * square;
  const double leading = 1 - half;
  const double rest = std::fma(square * square, polynomial(square, series), -high * low);
  return leading + (((1 - leading) - half) + rest);
}

double sin_of(const Reduced& angle) {
  const double magnitude = (angle.quarter & 1) != 0 ? cos_reduced(angle.high, angle.low) : sin_reduced(angle.high, angle.low);
  return (angle.quarter & 2) != 0 ? -magnitude : magnitude;
}

double cos_of(const Reduced& angle) { return sin_of({(angle.quarter + 1) & 3, angle.high, angle.low}); }

/// The number of quarter turns and the rest in degrees, |rest| <= 45; exact.
std::pair<double, double> reduce_degrees(double degrees) {
  expect(std::abs(degrees) <= angle_max, "an angle lies within a million degrees");
  const double quarters = std::nearbyint(degrees / 90);
  return {quarters, std::fma(-90.0, quarters, degrees)};
}

Reduced radians_from_degrees(double quarters, double degrees) {
  const double product = degrees * radian_per_degree;
  const double error = std::fma(degrees, radian_per_degree, -product);
  return renormalized(quarters, product, std::fma(degrees, radian_per_degree_tail, error));
}

/// The arc tangents of 0/8 to 8/8.
constexpr std::array<double, 9> arc_tangent_of_eighths = {0x0p+0,
                                                          0x1.fd5ba9aac2f6ep-4,
                                                          0x1.f5b75f92c80ddp-3,
                                                          0x1.6f61941e4def1p-2,
                                                          0x1.dac670561bb4fp-2,
                                                          0x1.1e00babdefeb4p-1,
                                                          0x1.4978fa3269ee1p-1,
                                                          0x1.700a7c5784634p-1,
                                                          0x1.921fb54442d18p-1};

/// The angle of y / x, 0 <= y <= x, x > 0: that of the nearest eighth, plus Taylor's series for the difference, whose tangent is
/// at most 1/16. The first omitted term is below 1e-19.
double first_octant(double y, double x) {
  static constexpr std::array<double, 7> series = {-1 / 15.0, 1 / 13.0, -1 / 11.0, 1 / 9.0, -1 / 7.0, 1 / 5.0, -1 / 3.0};
  const auto eighth = static_cast<std::size_t>(y / x * 8 + 0.5);
  const double share = static_cast<double>(eighth) * 0.125, tangent = (y - share * x) / (x + share * y),
               square = tangent * tangent;
  double sum = series[0];
  for (std::size_t i = 1; i < series.size(); ++i) {
    sum = sum * square + series[i];
  }
  return arc_tangent_of_eighths[eighth] + (tangent + tangent * square * sum);
}

double exponential_of(double x) {
  if (!(x > least_exponent)) {
    return std::isnan(x) ? x : 0;
  }
  return x > 709.79 ? std::numeric_limits<double>::infinity() : finite_exponential(x);
}

double natural_log_of(double x) {
  if (!(x > 0)) {
    return x == 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  }
  return finite_log(x);
}

/// `Function` compiled with this processor's fused multiply-add, which gives the same bits as libm's without a call for each.
template <auto Function, class... Numbers>
[[gnu::target("fma"), gnu::flatten]] double fused(Numbers... numbers) {
  return Function(numbers...);
}

template <auto Function, class... Numbers>
double dispatched(Numbers... numbers) {
  static const bool has_fma = __builtin_cpu_supports("fma") != 0;
  return has_fma ? fused<Function>(numbers...) : Function(numbers...);
}

/// The powers of ten that a double represents exactly.
constexpr std::array<double, 23> power_of_10 = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                                1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// An exact unevaluated sum: value times a power of ten (rounded), and the rounding error.
struct Scaled {
  double high = 0, low = 0;
};

/// value * 10 ^ power, -22 <= power <= 22. After a division only the sign of `low` is right, which is all that a tie needs.
Scaled scale_by_10(double value, int power) {
  const double factor = power_of_10[static_cast<std::size_t>(std::abs(power))];
  if (power >= 0) {
    const double high = value * factor;
    return {high, std::fma(value, factor, -high)};
  }
  const double high = value / factor;
  return {high, std::fma(-high, factor, value)};
}

/// The integer nearest to a sum between 0 and 1e7, ties to even. If `high` is not a tie, `low` is too small to matter.
double nearest_integer(const Scaled& sum) {
  const double below = static_cast<double>(static_cast<std::int64_t>(sum.high));
  const double beyond_half = (sum.high - below) - 0.5;
  const bool tie = beyond_half == 0;
  const bool odd = (static_cast<std::int64_t>(below) & 1) != 0;
  const bool up = tie ? (sum.low > 0 || (sum.low == 0 && odd)) : beyond_half > 0;
  return up ? below + 1 : below;
}

/// The power of ten that scales a positive value to six digits before the point; may be one too high.
int six_digit_power(double magnitude) {
  const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(magnitude) >> 52U) - 1023;
  constexpr double log10_of_2 = 0.30102999566398119521;
  const double decade = exponent * log10_of_2;
  const int below = static_cast<int>(decade) - (decade < static_cast<int>(decade) ? 1 : 0);
  return 5 - below;
}

/// The same result by way of text, for numbers whose power of ten is not exact in a double.
double round_by_text(double value) {
  std::array<char, 64> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
  double result = value;
  std::from_chars(text.data(), written.ptr, result);
  return result;
}

}  // namespace

double sin_radians(double radians) { return sin_of(reduce_radians(radians)); }
double cos_radians(double radians) { return cos_of(reduce_radians(radians)); }

double tan_radians(double radians) {
  const Reduced angle = reduce_radians(radians);
  return sin_of(angle) / cos_of(angle);
}

double angle_of(double y, double x) {
  const double across = std::fabs(x), up = std::fabs(y);
  if (across == 0 && up == 0) {
    return 0;
  }
  const double octant = up <= across ? first_octant(up, across) : half_pi - first_octant(across, up);
  return std::copysign(x < 0 ? 2 * half_pi - octant : octant, y);
}

double sin_degrees(double degrees) {
  const auto [quarters, rest] = reduce_degrees(degrees);
  const Reduced angle = radians_from_degrees(quarters, rest);
  if (std::abs(rest) == 30 && (angle.quarter & 1) == 0) {
    return (rest > 0) == (angle.quarter == 0) ? 0.5 : -0.5;
  }
  return sin_of(angle) + 0.0;  // never -0
}

double cos_degrees(double degrees) {
  const auto [quarters, rest] = reduce_degrees(degrees);
  const Reduced angle = radians_from_degrees(quarters, rest);
  if (std::abs(rest) == 30 && (angle.quarter & 1) == 1) {
    return (rest < 0) == (angle.quarter == 1) ? 0.5 : -0.5;
  }
  return cos_of(angle) + 0.0;
}

double tan_degrees(double degrees) { return sin_degrees(degrees) / cos_degrees(degrees); }

double exponential(double x) { return dispatched<exponential_of>(x); }
double natural_log(double x) { return dispatched<natural_log_of>(x); }
double pow_unit(double base, double exponent) { return dispatched<unit_power>(base, exponent); }

double round_to_6_digits(double value) {
  const double magnitude = std::abs(value);
  if (magnitude == 0 || !std::isfinite(value)) {
    return value;
  }
  if (magnitude < 1e-16 || magnitude >= 1e26) {
    return round_by_text(value);
  }
  int power = six_digit_power(magnitude);
  Scaled scaled = scale_by_10(magnitude, power);
  if (scaled.high >= 1e6) {
    scaled = scale_by_10(magnitude, --power);
  }
  const double digits = nearest_integer(scaled);
  const double factor = power_of_10[static_cast<std::size_t>(std::abs(power))];
  return std::copysign(power >= 0 ? digits / factor : digits * factor, value);
}

}  // namespace dmpc::core
