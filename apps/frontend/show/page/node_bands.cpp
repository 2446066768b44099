#include "apps/frontend/show/page/node_bands.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps::html {

namespace {

struct Band {
  const char* name;
  double share;  ///< share of nodes with at most this value
};
constexpr std::array<Band, 5> bands = {{{"least", 0}, {"5 %", 0.05}, {"50 %", 0.5}, {"95 %", 0.95}, {"most", 1}}};

constexpr const char* explained =
    "Over all nodes: the line is the median, the box holds nine of ten nodes, and the thin lines lead to the minimum and the "
    "maximum.";

/// Numbered, and no sum.
bool is_node(const Cell& cell) {
  const auto* const text = std::get_if<std::string>(&cell);
  return text == nullptr ||
         std::all_of(text->begin(), text->end(), [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

std::size_t node_count(const Table& table) {
  return static_cast<std::size_t>(
      std::count_if(table.rows().begin(), table.rows().end(), [](const auto& row) { return is_node(row.front()); }));
}

/// The cells of all nodes in ascending order.
std::vector<Cell> sorted_cells(const Table& table, std::size_t column) {
  std::vector<Cell> cells;
  for (const std::vector<Cell>& row : table.rows()) {
    if (is_node(row.front())) {
      cells.push_back(row[column]);
    }
  }
  std::ranges::sort(cells, {}, [](const Cell& cell) { return number_of(cell).value_or(0); });
  return cells;
}

/// Nearest-rank percentile: the first cell that a share of `share` of the nodes does not exceed.
const Cell& ranked(const std::vector<Cell>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted.at(std::max<std::size_t>(rank, 1) - 1);
}

}  // namespace

Table band_table(const Plot& plot, const Table& table) {
  const Column& measured = table.columns()[number_of_column(table, plot.series.front().column)];
  std::vector<Column> columns = {{"of each node", "", 0}};
  for (const Band& band : bands) {
    columns.push_back({band.name, measured.unit, measured.digits});
  }
  Table found(plot.title, std::move(columns));
  for (const PlotSeries& series : plot.series) {
    const std::vector<Cell> sorted = sorted_cells(table, number_of_column(table, series.column));
    std::vector<Cell> row = {series.title};
    for (const Band& band : bands) {
      row.push_back(ranked(sorted, band.share));
    }
    found.add_row(std::move(row));
  }
  return found;
}

Plot band_plot(const Plot& plot) {
  Plot drawn = curves(plot.name, plot.title, "of each node", {}, plot.y, {});
  drawn.series.push_back({.title = "nodes",
                          .column = bands[2].name,
                          .mark = PlotMark::bands,
                          .low = bands[0].name,
                          .high = bands[4].name,
                          .box_low = bands[1].name,
                          .box_high = bands[3].name});
  return drawn;
}

void add_node_plot(Page& page, const Plot& plot, const Table& table) {
  if (node_count(table) <= bars_max) {
    page.add_plot(plot, table);
  } else {
    page.add_plot(band_plot(plot), band_table(plot, table), explained);
  }
}

}  // namespace dmpc::apps::html
