// How long a render takes, beside what its picture takes by one thread alone.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/run/strategy_options.h"

namespace dmpc::apps {

/// A render that is going to be made.
struct PlannedRun {
  Strategy strategy = Strategy::svm;
  std::uint32_t node_count = 1;
  bool is_virtual = false;  ///< as many at a time as there are cores, each on one; else one at a time, by threads
  double times = 1;         ///< as long as usual
};

/// So many runs of each node count.
std::vector<PlannedRun> planned_for(const std::vector<std::uint32_t>& node_counts, const std::vector<PlannedRun>& each);

/// The processor time of one run, from what the one-thread renderer takes for the picture.
double seconds_of(const PlannedRun& run, double picture_seconds);

}  // namespace dmpc::apps
