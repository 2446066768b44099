#include "apps/frontend/table/averages.h"

#include <algorithm>
#include <cmath>

#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {

std::optional<double> geometric_mean(std::span<const double> numbers) {
  const double sum = core::sum_over<double>(numbers, [&](const double number) { return std::log(number); });
  return numbers.empty() ? std::nullopt : std::optional(std::exp(sum / static_cast<double>(numbers.size())));
}

double median(std::vector<double> numbers) {
  core::expect(!numbers.empty(), "a median is of some numbers");
  std::sort(numbers.begin(), numbers.end());
  const std::size_t half = numbers.size() / 2;
  return numbers.size() % 2 == 1 ? numbers[half] : (numbers[half - 1] + numbers[half]) / 2;
}

}  // namespace dmpc::apps
