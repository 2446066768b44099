// What emulating more nodes, and smaller caches, costs in `bench speed`.
#pragma once

#include <vector>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"

namespace dmpc::apps {

/// Times the phase `render` of each scene with svm on 2, 8 and 64 nodes whose caches hold all pages, on 8 with caches of a part
/// of the database, and with dataflow on 2 and 64. The films are expected to be one. `results`, progress and errors as
/// measure_kernel()'s.
void measure_emulation(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results);

}  // namespace dmpc::apps
