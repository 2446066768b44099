// The real computer's memory that a run takes, in `bench speed`.
#pragma once

#include <vector>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"

namespace dmpc::apps {

/// Runs `dmpc render` on 8 nodes as a process of its own, for each scene and for one of a single triangle, and holds the most
/// anonymous memory that it ever had, above the triangle's, against the sum of the nodes' local memories. Once: nothing is timed.
/// `results`, progress and errors as measure_kernel()'s; core::InputError too if the program cannot be run.
void measure_memory(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results);

}  // namespace dmpc::apps
