// Shows the distribution of a figure over many nodes, where bars would be too narrow.
#pragma once

#include <cstddef>

#include "apps/frontend/show/page/page.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

/// Up to this many nodes are shown as bars.
inline constexpr std::size_t bars_max = 64;

/// A row for each series of a plot by node: minimum, maximum, and the ranges of 90 % and of half of the nodes (nearest rank).
/// Rows of `table` for other things than nodes, such as sums, are ignored; at least one must be a node's.
Table band_table(const Plot& plot, const Table& table);
/// The plot of a band table.
Plot band_plot(const Plot& plot);

/// A plot by node: bars of up to bars_max nodes, otherwise bands.
void add_node_plot(Page& page, const Plot& plot, const Table& table);

}  // namespace dmpc::apps::html
