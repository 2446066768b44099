// The comparisons of `bench speed` as tables, what they come to and all, and as pictures.
#pragma once

#include <span>
#include <string>

#include "apps/edge/table/plot.h"
#include "apps/edge/table/table.h"
#include "apps/lab/bench/speed/comparison.h"

namespace dmpc::apps {

/// For each part, thing measured and pair the geometric mean of the ratios over scenes and kinds, in processor time, too, where
/// there are two clocks, and of each kind by itself, and the outermost ones, in the order in which they come first; no mean where
/// a ratio is 0.
Table headline_of(std::span<const Comparison> comparisons, const std::string& title);

/// A row for each comparison that has been measured, in their order.
Table table_of(std::span<const Comparison> comparisons, const std::string& title);

/// What the plot of a part is drawn from: a row for each scene, what is compared, and pair of contenders, with the geometric mean
/// of the ratios over the details.
Table plotted_table(SpeedPart part, std::span<const Comparison> comparisons);

/// Bars of the ratios in a part's plotted table, side by side at each scene and what is compared.
Plot plot_of(SpeedPart part, const Table& plotted, const std::string& name);

}  // namespace dmpc::apps
