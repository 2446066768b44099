// Predicts how long a run would have taken with caches of other sizes, from data of that run alone.
//
// Its miss curve (miss_estimate.h) gives the number of faults; their cost cannot be known from one run. Two readings of its time
// bracket it: (A) all time except computing grows with the faults, as where nodes wait for each other because they wait for
// pages; (B) only the time for pages does: page wait, service of interrupts, messages. Either may be the longer one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "apps/frontend/run/miss_estimate.h"
#include "apps/frontend/run/time_parts.h"

namespace dmpc::apps {

/// The measured run, on a modelled machine.
struct ForecastRun {
  TimeParts parts;                ///< sums over all nodes
  std::uint32_t node_count = 1;   ///< without the host
  std::uint32_t cache_pages = 0;  ///< per node
  std::uint64_t faults = 0;       ///< sum over all nodes

  double total_ns() const { return static_cast<double>(parts.total_ns()) / node_count; }
};

/// The prediction for a cache of another size.
struct TimeBand {
  std::uint32_t cache_pages = 0;
  double faults = 0;                 ///< by the run's own curve, compared with its own faults
  double least_ns = 0, most_ns = 0;  ///< interval of both readings, as wide as the curve is uncertain

  double width() const { return most_ns / std::max(least_ns, 1.0) - 1; }
  /// Wider bands are called vague.
  static constexpr double width_max = 0.1;
  bool is_narrow() const { return width() <= width_max; }
};

struct CacheForecast {
  ForecastRun run;
  std::vector<TimeBand> sizes;  ///< four sizes per doubling, including powers of two, and the run's own
  std::uint32_t every = 1;      ///< the curve's MissEstimate::every
  double curve_error = 0;       ///< difference between the curve and the run's own faults, as a share of them
  double sample_error = 0;      ///< for a curve from a sample: the largest error at these sizes, as a share
};

/// For caches of up to `pages_max` pages. No sizes if nothing can be predicted: the run had no faults, its cache is too small for
/// the sample, or it took no time.
///
/// Faults are scaled: the curve's at that size, relative to the curve's at the run's own size or to the run's own faults. These
/// differ where several pixels wait for one page or the policy is not lru; the band covers both. For a sampled curve, the same
/// ratio from half of its pages differs from it about as much as it differs from the truth; twice that is added on both sides,
/// and at least as much as at sizes nearer to the run's own.
CacheForecast forecast_caches(const ForecastRun& run, const MissEstimate& misses, std::uint32_t pages_max);

}  // namespace dmpc::apps
