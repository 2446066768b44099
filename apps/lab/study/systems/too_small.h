// Whether a run was long enough to compare systems by it.
#pragma once

#include <string>

namespace dmpc::apps {

/// Shares of a run's time, from 0 to 1.
struct RunShares {
  double computing = 0, film_wait = 0, idle_at_end = 0;  ///< means over the nodes
  double host_busy = 0;
};

struct PictureSize {
  int width = 0, height = 0, samples = 1;
};

/// Returns what decides a run in place of rays and pages, and which picture would do: "nodes wait for film or are idle at the
/// end for 73 % of the time: --samples=3 or more would do". Empty for a run that is large enough: film and the end are at most
/// half of the nodes' time, and the host is busy for at most half of the run.
std::string too_small(const RunShares& shares, const PictureSize& picture);

}  // namespace dmpc::apps
