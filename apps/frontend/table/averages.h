// Averages of measured numbers.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace dmpc::apps {

/// Returns the geometric mean of numbers above 0; nothing if there are none.
std::optional<double> geometric_mean(std::span<const double> numbers);

/// Returns the middle number, or the mean of the two middle ones. Requires at least one.
double median(std::vector<double> numbers);

}  // namespace dmpc::apps
