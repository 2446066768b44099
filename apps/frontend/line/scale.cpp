#include "apps/frontend/line/scale.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "core/base/elementary.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// So many ticks at most, if steps can be chosen.
constexpr double linear_ticks_max = 6;
/// A logarithmic scale that spans more than this factor has one tick a decade.
constexpr double wide_factor = 2000;

/// So far beyond the end, a tick still stands at it.
constexpr double rounding = 1e-12;

constexpr double round_digits[] = {1, 2, 5};

/// The greatest power of ten that is not above `value`, which is above 0.
double power_below(double value) {
  double power = 1;
  while (power > value) {
    power /= 10;
  }
  while (power * 10 <= value) {
    power *= 10;
  }
  return power;
}

/// The least of 1, 2 and 5 times powers of ten that is not below `value`, which is above 0.
double round_up(double value) {
  const double power = power_below(value);
  for (const double digit : round_digits) {
    if (digit * power >= value) {
      return digit * power;
    }
  }
  return 10 * power;
}

std::vector<double> linear_ticks(double least, double largest) {
  const double step = round_up((largest - least) / linear_ticks_max);
  std::vector<double> ticks;
  const auto first = static_cast<std::int64_t>(least / step);
  for (std::int64_t i = first; static_cast<double>(i) * step <= largest * (1 + rounding); ++i) {
    if (static_cast<double>(i) * step >= least * (1 - rounding)) {
      ticks.push_back(static_cast<double>(i) * step);
    }
  }
  return ticks;
}

std::vector<double> logarithmic_ticks(double least, double largest) {
  const bool is_wide = largest > wide_factor * least;
  std::vector<double> ticks;
  for (double power = power_below(least); power <= largest; power *= 10) {
    for (const double digit : round_digits) {
      const double tick = digit * power;
      if (tick >= least && tick <= largest && (digit == 1 || !is_wide)) {
        ticks.push_back(tick);
      }
    }
  }
  return ticks;
}

}  // namespace

double NumberScale::position(double value) const {
  if (!(largest > least)) {
    return 0;
  }
  const double inside = std::clamp(value, least, largest);
  return is_logarithmic ? core::natural_log(inside / least) / core::natural_log(largest / least)
                        : (inside - least) / (largest - least);
}

std::vector<double> NumberScale::ticks() const {
  if (!(largest > least)) {
    return {least};
  }
  return is_logarithmic ? logarithmic_ticks(least, largest) : linear_ticks(least, largest);
}

NumberScale scale_for(std::span<const double> values) {
  core::expect(!values.empty(), "a scale is made for some numbers");
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  core::expect(*least >= 0 && *largest <= 1e300, "a scale is of finite numbers that are not negative");
  std::vector<double> above_zero;
  std::copy_if(values.begin(), values.end(), std::back_inserter(above_zero), [](double value) { return value > 0; });
  if (above_zero.empty()) {
    return {};
  }
  const auto middle = above_zero.begin() + static_cast<std::ptrdiff_t>(above_zero.size() / 2);
  std::nth_element(above_zero.begin(), middle, above_zero.end());
  if (*middle * 16 < *largest) {
    return {true, *std::min_element(above_zero.begin(), above_zero.end()), *largest};
  }
  return {false, *least, *largest};
}

}  // namespace dmpc::apps
