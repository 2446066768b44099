// A table with a row per node, defined by its columns.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/frontend/show/counters.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "nodes/counters.h"

namespace dmpc::apps::html {

/// A column's values, by number of the node.
struct NodeColumn {
  Column column;
  std::function<Cell(std::size_t node)> cell;
};
using NodeColumns = std::vector<NodeColumn>;

Table node_table(const std::string& title, std::size_t node_count, const NodeColumns& columns);

/// A number per node.
NodeColumn count_column(const std::string& name, std::function<std::uint64_t(std::size_t node)> count,
                        const std::string& unit = "");
/// Bytes per node, in KiB.
NodeColumn kibibyte_column(const std::string& name, std::function<std::size_t(std::size_t node)> bytes);
/// Traffic that each node sent and received.
NodeColumns traffic_columns(const std::function<const nodes::NodeCounters&(std::size_t node)>& counters);

/// A column per counter that has one. `counters` returns a node's.
template <class Counters>
NodeColumns counter_columns(const std::function<const Counters&(std::size_t node)>& counters) {
  NodeColumns columns;
  for (const Counter<Counters>& row : counters_of<Counters>) {
    if (*row.column != '\0') {
      columns.push_back(count_column(row.column, [&row, counters](std::size_t node) { return row.value(counters(node)); }));
    }
  }
  return columns;
}

void append(NodeColumns& columns, const NodeColumns& more);

/// The plot of a table with the columns of page counters.
Plot fault_plot();

}  // namespace dmpc::apps::html
