#include "apps/lab/study/scale/growth.h"

#include <cstddef>
#include <vector>

#include "core/base/elementary.h"

namespace dmpc::apps {
namespace {

using Points = std::vector<std::pair<double, double>>;

/// Measured from the first, so that what does not grow at all comes out as 0.
Points logarithms(std::span<const std::pair<double, double>> points) {
  Points logs;
  for (const auto& [x, y] : points) {
    if (x > 0 && y > 0) {
      logs.emplace_back(core::natural_log(x), core::natural_log(y));
    }
  }
  for (std::size_t i = logs.size(); i-- > 0;) {
    logs[i] = {logs[i].first - logs[0].first, logs[i].second - logs[0].second};
  }
  return logs;
}

}  // namespace

std::optional<double> growth_exponent(std::span<const std::pair<double, double>> points) {
  const Points logs = logarithms(points);
  double x_sum = 0, y_sum = 0;
  for (const auto& [x, y] : logs) {
    x_sum += x;
    y_sum += y;
  }
  const double count = static_cast<double>(logs.size());
  double squares = 0, products = 0;
  for (const auto& [x, y] : logs) {
    const double from_middle = x - x_sum / count;
    squares += from_middle * from_middle;
    products += from_middle * (y - y_sum / count);
  }
  constexpr double same = 1e-12;  // what rounding leaves of equal x
  return squares > same ? std::optional(products / squares) : std::nullopt;
}

}  // namespace dmpc::apps
