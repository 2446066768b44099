// What stability tests count, and what a count of failures says about their rate.
#pragma once

#include <array>
#include <cstdint>

#include "apps/lab/bench/stability/kernels.h"

namespace dmpc::apps {

/// What one kernel came to in one test. A ray fails in one way at most.
struct StabilityCounts {
  std::uint64_t tried = 0;           ///< rays, or points
  std::uint64_t leaks = 0;           ///< missed what cannot be missed by rounding
  std::uint64_t wrong_hits = 0;      ///< hit what cannot be hit by rounding, or what lies behind something that cannot be missed
  std::uint64_t double_claims = 0;   ///< a hit that more than one owner of space claims
  std::uint64_t unexplained = 0;     ///< other bits than the grid's, or a distance farther off than rounding can move it
  std::uint64_t explained = 0;       ///< another answer than the grid's, within rounding: no failure
  std::uint64_t error_milliulp = 0;  ///< the worst error of a distance, in thousandths of a float's last place; 0: not measured

  // What was known of the rays before, or asked of them after: a claim about rays of which there were none says nothing.
  std::uint64_t sure_hits = 0, sure_misses = 0;  ///< that must hit, must miss, by geometry
  std::uint64_t heard = 0;                       ///< that the referee was asked about

  std::uint64_t failures() const { return leaks + wrong_hits + double_claims + unexplained; }
  bool operator==(const StabilityCounts&) const = default;
};

/// Sums field by field; of the errors the worst. The order of sums does not matter.
StabilityCounts& operator+=(StabilityCounts& sum, const StabilityCounts& more);

using KernelCounts = std::array<StabilityCounts, stability_kernel_count>;
KernelCounts& operator+=(KernelCounts& sum, const KernelCounts& more);

/// The rate of failures that is not exceeded with a confidence of 95 %, for independent tries; `tried` > 0. 3 / tried where none
/// failed, else half the chi-squared distribution's quantile with 2 (failures + 1) degrees of freedom over `tried`, by E. B.
/// Wilson and M. M. Hilferty, "The Distribution of Chi-Square", 1931: within 1 %. At most 1.
double failure_rate_bound(std::uint64_t failures, std::uint64_t tried);

}  // namespace dmpc::apps
