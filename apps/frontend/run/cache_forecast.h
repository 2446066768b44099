// How long a run would have taken with caches of other sizes, as far as that run itself tells.
//
// From its miss curve (miss_estimate.h) is known how many faults there would be; what those cost, one run alone does not say. Two
// readings of its time bracket it. (A) all that is no computing grows with the faults, as where nodes wait for each other because
// they wait for pages; (B) only what pages take does: page wait, service of interrupts, messages. Either may be the longer one.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/frontend/run/miss_estimate.h"
#include "apps/frontend/run/time_parts.h"

namespace dmpc::apps {

/// The run that tells, on a modelled machine.
struct ForecastRun {
  TimeParts parts;                ///< sums over all nodes
  std::uint32_t node_count = 1;   ///< without the host
  std::uint32_t cache_pages = 0;  ///< per node
  std::uint64_t faults = 0;       ///< sum over all nodes

  double total_ns() const { return static_cast<double>(parts.total_ns()) / node_count; }
};

/// With a cache of another size.
struct TimeBand {
  std::uint32_t cache_pages = 0;
  double faults = 0;                 ///< by the run's own curve, held against its own faults
  double least_ns = 0, most_ns = 0;  ///< interval of both readings, as wide as the curve is uncertain

  double width() const { return most_ns / least_ns - 1; }
  /// Wider ones say too little to be shown.
  static constexpr double width_max = 0.1;
  bool is_narrow() const { return width() <= width_max; }
};

struct CacheForecast {
  ForecastRun run;
  std::vector<TimeBand> sizes;  ///< four for each doubling, powers of two among them, and the run's own
  std::uint32_t every = 1;      ///< the curve's MissEstimate::every
  double curve_error = 0;       ///< by how much the curve misses the run's own faults, as a share of them
  double sample_error = 0;      ///< for a curve from a sample: the largest error at these sizes, as a share
};

/// For caches of up to `pages_max` pages. Of no sizes where nothing can be told: the run had no faults, its cache is too small
/// for the sample, or it took no time.
///
/// Faults are taken in proportion: the curve's at that size to the curve's at the run's own, or to the run's own faults, which
/// differ where several pixels wait for one page or another policy than lru replaces; the band has both. Where the curve is a
/// sample's, the same proportion from half of its pages differs from it about as much as it differs from the truth; twice that is
/// added on both sides, and not less than at sizes nearer to the run's own.
CacheForecast forecast_caches(const ForecastRun& run, const MissEstimate& misses, std::uint32_t pages_max);

}  // namespace dmpc::apps
