// Carries out the cases of stability tests, batch by batch, over the real computer's cores.
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

/// What a case came to, of all kernels together.
struct StabilityTrial {
  std::string row, name;
  StabilityCounts counts{};
};

/// What a run has counted in all batches so far.
struct StabilityState {
  std::size_t cases_done = 0;
  std::uint64_t rays_done = 0;  ///< sum over all cases
  std::vector<StabilityRow> rows;
  std::vector<StabilityTrial> trials;  ///< by case

  /// Rays of all rows that our own kernels failed, each kernel for itself.
  std::uint64_t own_failures() const;
  /// Finished cases that have tried nothing: their claims remain untested.
  std::vector<std::string> blind_cases() const;
};

/// Carries out the cases. A batch of rays is the same whatever the number of cores, and so is what it draws: a hash of `seed`,
/// case and batch. After each batch, in their order and one at a time, calls after_batch(), which may throw to stop: `state` then
/// has what was counted before. Whatever a batch throws is thrown on.
void run_stability(
    const StabilityCases& cases, std::uint64_t seed, StabilityState& state, const std::function<void()>& after_batch = [] {});

std::uint64_t total_rays(const StabilityCases& cases);

/// The cases of the tests named ("R1", "quadrics"; all if none is), in the order of grid tests R1 to R16. Throws core::UsageError
/// for a name that is none, saying what there is.
StabilityCases stability_cases(const StabilityAmount& amount, const std::vector<std::string>& tests);

}  // namespace dmpc::apps
