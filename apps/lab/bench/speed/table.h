// The comparisons of `bench speed` as a table, and as pictures of it.
#pragma once

#include <span>
#include <string>

#include "apps/edge/table/plot.h"
#include "apps/edge/table/table.h"
#include "apps/lab/bench/speed/comparison.h"

namespace dmpc::apps {

/// A row for each comparison that has been measured, in their order.
Table table_of(std::span<const Comparison> comparisons, const std::string& title);

/// What the plot of a part is drawn from: a row for each scene, what is compared, and pair of contenders, with the geometric mean
/// of the ratios over the details.
Table plotted_table(SpeedPart part, std::span<const Comparison> comparisons);

/// Bars of the ratios in a part's plotted table, side by side at each scene and what is compared.
Plot plot_of(SpeedPart part, const Table& plotted, const std::string& name);

/// `plot` with a series of bars for each text of the column number `kind`, in their order, as high as `height`.
Plot with_bars(const std::string& height, std::size_t kind, const Table& table, Plot plot);

}  // namespace dmpc::apps
