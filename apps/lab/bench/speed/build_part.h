// Building databases in `bench speed`, beside Embree's trees.
#pragma once

#include <vector>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"

namespace dmpc::apps {

/// Builds each scene's database and two of Embree's trees, the robust one and the fast one of high quality, on each number of
/// threads. Embree's time is its tree's alone, from vertices that lie ready; ours is from the scene to the pages. `results`,
/// progress and errors as measure_kernel()'s.
void measure_build(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results);

}  // namespace dmpc::apps
