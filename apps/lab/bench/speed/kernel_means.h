// What the kernel's ratios come to over all scenes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/speed/comparison.h"

namespace dmpc::apps {

/// For each pair of contenders and number of threads a sentence with the geometric means over the scenes, of each query and of
/// its classes of rays: "grid over Embree robust, threads: 1; closest hit 0.31 (primary 0.42, ...), any hit ...". Comparisons of
/// other parts and without a round are left out.
std::vector<std::string> kernel_means(std::span<const Comparison> comparisons);

}  // namespace dmpc::apps
