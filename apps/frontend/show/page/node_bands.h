// How a figure of many nodes is spread out over them, where a bar for each could not be told from the next.
#pragma once

#include <cstddef>

#include "apps/frontend/show/page/page.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

/// Up to this many nodes are shown as bars.
inline constexpr std::size_t bars_max = 64;

/// A row for each series of a plot by node: what the node with the least has, with the most, and those between which 90 % lie and
/// half (nearest rank). Rows of `table` that are no node's, such as sums, are left out; there must be one that is.
Table band_table(const Plot& plot, const Table& table);
/// The plot of a band table.
Plot band_plot(const Plot& plot);

/// A plot by node: bars of up to bars_max nodes, bands of more.
void add_node_plot(Page& page, const Plot& plot, const Table& table);

}  // namespace dmpc::apps::html
