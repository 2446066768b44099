#include "apps/frontend/show/page/node_table.h"

#include <utility>

#include "apps/frontend/line/amount.h"

namespace dmpc::apps::html {

Table node_table(const std::string& title, std::size_t node_count, const NodeColumns& columns) {
  std::vector<Column> all = {{"node", "", 0}};
  for (const NodeColumn& column : columns) {
    all.push_back(column.column);
  }
  Table table(title, std::move(all));
  for (std::size_t node = 0; node < node_count; ++node) {
    std::vector<Cell> row = {std::uint64_t{node}};
    for (const NodeColumn& column : columns) {
      row.push_back(column.cell(node));
    }
    table.add_row(std::move(row));
  }
  return table;
}

NodeColumn count_column(const std::string& name, std::function<std::uint64_t(std::size_t node)> count, const std::string& unit) {
  return {{name, unit, 0}, std::move(count)};
}

NodeColumn kibibyte_column(const std::string& name, std::function<std::size_t(std::size_t node)> bytes) {
  return {{name, "KiB", 1}, [bytes = std::move(bytes)](std::size_t node) { return kibibytes(bytes(node)); }};
}

NodeColumns traffic_columns(const std::function<const nodes::NodeCounters&(std::size_t node)>& counters) {
  const auto of = [&counters](nodes::TrafficByKind nodes::NodeCounters::*way, std::uint64_t nodes::Traffic::*figure) {
    return [counters, way, figure](std::size_t node) { return total(counters(node).*way).*figure; };
  };
  using nodes::NodeCounters;
  using nodes::Traffic;
  return {count_column("packets sent", of(&NodeCounters::sent, &Traffic::packets)),
          count_column("sent", of(&NodeCounters::sent, &Traffic::bytes), "bytes"),
          count_column("packets received", of(&NodeCounters::received, &Traffic::packets)),
          count_column("received", of(&NodeCounters::received, &Traffic::bytes), "bytes")};
}

void append(NodeColumns& columns, const NodeColumns& more) { columns.insert(columns.end(), more.begin(), more.end()); }

Plot fault_plot() {
  return bars_by_node("node_faults", "Pages asked for and served", {.label = "", .least = 0},
                      {{"faults", "faults"}, {.title = "pages served", .column = "pages served", .color = 1}});
}

}  // namespace dmpc::apps::html
