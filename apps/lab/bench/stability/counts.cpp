#include "apps/lab/bench/stability/counts.h"

#include <algorithm>
#include <cmath>

#include "core/base/counts.h"

namespace dmpc::apps {

StabilityCounts& operator+=(StabilityCounts& sum, const StabilityCounts& more) {
  const std::uint64_t worst = std::max(sum.error_milliulp, more.error_milliulp);
  core::add_counts(sum, more).error_milliulp = worst;
  return sum;
}

KernelCounts& operator+=(KernelCounts& sum, const KernelCounts& more) {
  for (std::size_t kernel = 0; kernel < sum.size(); ++kernel) {
    sum[kernel] += more[kernel];
  }
  return sum;
}

double failure_rate_bound(std::uint64_t failures, std::uint64_t tried) {
  if (failures == 0) {
    return std::min(1.0, 3.0 / static_cast<double>(tried));
  }
  constexpr double normal_quantile = 1.6448536269514722;  // 95 % quantile of a normal distribution
  const double count = static_cast<double>(failures) + 1;
  const double root = 1 - 1 / (9 * count) + normal_quantile / (3 * std::sqrt(count));
  return std::min(1.0, count * root * root * root / static_cast<double>(tried));
}

}  // namespace dmpc::apps
