// From which work on a computer of many nodes costs little more than that work.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/speed/comparison.h"

namespace dmpc::apps {

/// What comparisons of items are called.
inline constexpr const char* item_comparison = "work an item";
/// What many nodes may cost, in times of the work alone.
inline constexpr double item_cost_max = 1.3;

/// For each subject of such comparisons, whose figures are microseconds of processor time an item beside those of its work alone:
/// a sentence with the least work an item at which it costs item_cost_max, between the two measured ones on either side of that,
/// as ratios fall in proportion to logarithms. After E. Slaughter and others, "Task Bench" (SC 2020): minimum effective task
/// granularity.
std::vector<std::string> smallest_items(std::span<const Comparison> comparisons);

}  // namespace dmpc::apps
