// The comparisons of `bench speed` as tables: what they come to, and all.
#pragma once

#include <span>
#include <string>

#include "apps/edge/table/table.h"
#include "apps/lab/bench/speed/comparison.h"

namespace dmpc::apps {

/// For each part, thing measured and pair the geometric mean of the ratios over scenes and kinds, in processor time, too, where
/// there are two clocks, and of each kind by itself, and the outermost ones, in the order in which they come first; no mean where
/// a ratio is 0.
Table headline_of(std::span<const Comparison> comparisons, const std::string& title);

/// A row for each comparison that has been measured, in their order.
Table table_of(std::span<const Comparison> comparisons, const std::string& title);

}  // namespace dmpc::apps
