// Runs the cases of stability tests, batch by batch, on the real computer's cores.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/lab/bench/stability/case.h"

namespace dmpc::apps {

/// A row of the table: the sum over the cases that count for it.
struct StabilityRow {
  std::string name;
  KernelCounts counts{};
};

struct StabilityTrial {
  std::string row, name;
  StabilityCounts counts{};
};

/// The counts of all batches so far.
struct StabilityState {
  std::size_t cases_done = 0;
  std::uint64_t rays_done = 0;  ///< sum over all cases
  std::vector<StabilityRow> rows;
  std::vector<StabilityTrial> trials;  ///< by case

  /// Returns the failures of our own kernels over all rows, summed over kernels.
  std::uint64_t own_failures() const;
  /// Returns finished cases that have tried nothing: their claims remain untested.
  std::vector<std::string> blind_cases() const;
};

/// Runs the cases. A batch of rays, and a hash of `seed`, case and batch from which it draws, are the same for any number of
/// cores. After each batch, in their order and one at a time, it calls after_batch(), which may throw to stop: `state` then has
/// what was counted before. Exceptions of a batch are rethrown.
void run_stability(
    const StabilityCases& cases, std::uint64_t seed, StabilityState& state, const std::function<void()>& after_batch = [] {});

std::uint64_t total_rays(const StabilityCases& cases);

/// Returns the cases of the named tests ("R1", "quadrics"; all if none is named), in the order of grid tests R1 to R16. Throws
/// core::UsageError, which lists the tests, for an unknown name.
StabilityCases stability_cases(const StabilityAmount& amount, const std::vector<std::string>& tests);

}  // namespace dmpc::apps
