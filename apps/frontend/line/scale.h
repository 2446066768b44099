// Maps numbers to positions on a colour scale or an axis, and chooses round numbers for its ticks.
#pragma once

#include <span>
#include <vector>

namespace dmpc::apps {

/// Linear from the least number to the largest, or logarithmic from the least above 0 to the largest.
struct NumberScale {
  bool is_logarithmic = false;
  double least = 0, largest = 0;

  /// 0 for the least, 1 for the largest, clamped; 0 where they are equal.
  double position(double value) const;
  /// Round numbers within the scale, ascending: 1, 2 or 5 times powers of ten, or their multiples; few enough for a legend.
  std::vector<double> ticks() const;
};

/// Logarithmic where a linear scale would show little: if half of the numbers above 0 are below a sixteenth of the largest.
/// Requires finite numbers >= 0, and at least one.
NumberScale scale_for(std::span<const double> values);

}  // namespace dmpc::apps
