// The size and the order of our databases in `bench speed`, beside Table 2 of the 1994 article.
#pragma once

#include <vector>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"

namespace dmpc::apps {

/// Counts KB and distinct pages a pixel of each scene that the article has, once: nothing is timed. Rays are counted by the
/// article's convention. `results`, progress and errors as measure_kernel()'s.
void measure_pages(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results);

}  // namespace dmpc::apps
