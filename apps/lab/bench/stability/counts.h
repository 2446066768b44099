// The counts of stability tests, and the failure rates that they imply.
#pragma once

#include <array>
#include <cstdint>

#include "apps/lab/bench/stability/kernels.h"

namespace dmpc::apps {

/// Counts of one kernel in one test. A ray fails in at most one way.
struct StabilityCounts {
  std::uint64_t tried = 0;           ///< rays, or points
  std::uint64_t leaks = 0;           ///< missed what rounding cannot make it miss
  std::uint64_t wrong_hits = 0;      ///< hit what rounding cannot make it hit, or what lies behind something that rounding cannot
                                     ///< make it miss
  std::uint64_t double_claims = 0;   ///< a hit claimed by more than one owner of space
  std::uint64_t unexplained = 0;     ///< bits other than the grid's, or a distance farther off than rounding explains
  std::uint64_t explained = 0;       ///< an answer other than the grid's, within rounding: no failure
  std::uint64_t error_milliulp = 0;  ///< the worst error of a distance, in thousandths of a float's last place; 0: not measured

  // What was known of the rays before, or checked after: a claim about no rays is void.
  std::uint64_t sure_hits = 0, sure_misses = 0;  ///< must hit or miss by geometry
  std::uint64_t heard = 0;                       ///< were judged by the referee

  std::uint64_t failures() const { return leaks + wrong_hits + double_claims + unexplained; }
  bool operator==(const StabilityCounts&) const = default;
};

/// Sums field by field; errors take the maximum. The order of sums does not matter.
StabilityCounts& operator+=(StabilityCounts& sum, const StabilityCounts& more);

using KernelCounts = std::array<StabilityCounts, stability_kernel_count>;
KernelCounts& operator+=(KernelCounts& sum, const KernelCounts& more);

/// Returns the rate of failures that is not exceeded with a confidence of 95 %, for independent tries; `tried` > 0. It is 3 /
/// tried if none failed, else half the chi-squared distribution's quantile with 2 (failures + 1) degrees of freedom over `tried`,
/// by E. B. Wilson and M. M. Hilferty, "The Distribution of Chi-Square", 1931: within 1 %. At most 1.
double failure_rate_bound(std::uint64_t failures, std::uint64_t tried);

}  // namespace dmpc::apps
