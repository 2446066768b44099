// The kernel of `bench speed`: rays a second of our grid, one by one and in bundles, beside Embree's.
#pragma once

#include <vector>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"

namespace dmpc::apps {

/// Records each scene's rays and lets everybody trace them, class by class, as closest and as any hit, on each number of threads,
/// all in every round. `results` has what is measured so far at any time, thrown at or not. Progress goes to stderr if that is a
/// terminal. Throws Interrupted after a signal; core::InputError for a scene that will not do.
void measure_kernel(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results);

}  // namespace dmpc::apps
