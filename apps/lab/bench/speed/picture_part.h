// A whole picture in `bench speed`: load, build, render and write, by our grid and by Embree.
#pragma once

#include <vector>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"

namespace dmpc::apps {

/// Renders each scene as `render` does, on two nodes: with svm and our grid, and replicated with Embree, whose tree is built
/// within its phase `render`. `results`, progress and errors as measure_kernel()'s.
void measure_picture(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results);

}  // namespace dmpc::apps
