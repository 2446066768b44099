// Intervals of real numbers with outward-rounded double ends: they are guaranteed to contain the exact result.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace dmpc::core {

namespace directed {

/// The next double below or above `x`, or the one after it, without changing the rounding mode. Source: S. M. Rump, P.
/// Zimmermann, S. Boldo, G. Melquiond, "Computing predecessor and successor in rounding to nearest", BIT 49, 2009.
inline double step(double x) { return std::fabs(x) * (0x1p-53 * (1 + 0x1p-52)) + std::numeric_limits<double>::denorm_min(); }
inline double below(double x) { return x - step(x); }
inline double above(double x) { return x + step(x); }

/// The exact rounding error of a sum, unless it overflows. Source: D. E. Knuth, The Art of Computer Programming 2, section 4.2.2.
inline double sum_rest(double a, double b, double sum) {
  const double b_taken = sum - a;
  return (a - (sum - b_taken)) + (b - b_taken);
}
/// The rounding error of a product nearer to 0 than this may itself be rounded.
inline constexpr double product_min = 0x1p-960;

/// A lower or upper bound of the exact result; `rest` is the rounding error of `rounded`. A NaN in `rest` moves it, too.
inline double floor_of(double rounded, double rest) { return rest >= 0.0 ? rounded : below(rounded); }
inline double ceiling_of(double rounded, double rest) { return rest <= 0.0 ? rounded : above(rounded); }

inline double sum_floor(double a, double b) { return floor_of(a + b, sum_rest(a, b, a + b)); }
inline double sum_ceiling(double a, double b) { return ceiling_of(a + b, sum_rest(a, b, a + b)); }

inline bool has_exact_rest(double a, double b, double product) {
  return std::fabs(product) >= product_min || a == 0.0 || b == 0.0;
}
inline double product_floor(double a, double b) {
  return has_exact_rest(a, b, a * b) ? floor_of(a * b, std::fma(a, b, -(a * b))) : below(a * b);
}
inline double product_ceiling(double a, double b) {
  return has_exact_rest(a, b, a * b) ? ceiling_of(a * b, std::fma(a, b, -(a * b))) : above(a * b);
}

}  // namespace directed

/// All reals from `low` to `high`; an end is infinite where nothing is known. The result of an operation contains the results for
/// all reals of its operands, and therefore what doubles compute from them by the same operations, each rounded to nearest. Sums,
/// differences and products are the tightest possible (by error-free transformations; T. Ogita, S. M. Rump, S. Oishi, "Accurate
/// Sum and Dot Product", 2005), so a result that is exact in double has width 0. Source: R. E. Moore, Interval Analysis, 1966.
struct Interval {
  double low = 0, high = 0;

  constexpr Interval() = default;
  constexpr Interval(double exactly) : low(exactly), high(exactly) {}
  constexpr Interval(double from, double to) : low(from), high(to) {}
  static constexpr Interval everything() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }

  bool holds(double x) const { return low <= x && x <= high; }
  bool is_bounded() const { return std::isfinite(low) && std::isfinite(high); }
  double width() const { return directed::sum_ceiling(high, -low); }
  /// The largest and the least magnitude in the interval.
  double most() const { return std::max(-low, high); }
  double least() const { return std::max({low, -high, 0.0}); }
};

/// An interval from computed ends; a NaN makes it all reals.
inline Interval checked(double low, double high) { return low <= high ? Interval(low, high) : Interval::everything(); }

inline Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
inline Interval operator+(const Interval& a, const Interval& b) {
  return checked(directed::sum_floor(a.low, b.low), directed::sum_ceiling(a.high, b.high));
}
inline Interval operator-(const Interval& a, const Interval& b) { return a + -b; }

inline Interval operator*(const Interval& a, const Interval& b) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double x : {a.low, a.high}) {
    for (const double y : {b.low, b.high}) {
      const double least = directed::product_floor(x, y), most = directed::product_ceiling(x, y);
      if (!(least <= most)) {
        return Interval::everything();
      }
      low = std::min(low, least);
      high = std::max(high, most);
    }
  }
  return {low, high};
}

inline Interval operator/(const Interval& a, const Interval& b) {
  if (!a.is_bounded() || !(b.low > 0.0 || b.high < 0.0)) {
    return Interval::everything();
  }
  const auto [least, most] = std::minmax({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
  return checked(directed::below(least), directed::above(most));
}

/// Contains |x| for all x in `a`.
inline Interval magnitude(const Interval& a) { return {a.least(), a.most()}; }

}  // namespace dmpc::core
