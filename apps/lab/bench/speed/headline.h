// The few figures that a long `bench speed` comes to.
#pragma once

#include <span>
#include <string>

#include "apps/edge/table/table.h"
#include "apps/lab/bench/speed/comparison.h"

namespace dmpc::apps {

/// For each part, thing measured and pair the geometric mean of the ratios over scenes and kinds, and the outermost ones, in the
/// order in which they come first, but for part plain, which has a table of its own; no mean where a ratio is 0. Times are those
/// of the wall clock, where there are two.
Table headline_of(std::span<const Comparison> comparisons, const std::string& title);

}  // namespace dmpc::apps
