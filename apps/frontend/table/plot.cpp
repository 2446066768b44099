#include "apps/frontend/table/plot.h"

#include <cstddef>
#include <utility>

namespace dmpc::apps {

Plot curves(std::string name, std::string title, std::string place, PlotAxis x, PlotAxis y, std::vector<PlotSeries> series) {
  Plot plot;
  plot.name = std::move(name);
  plot.title = std::move(title);
  plot.place = std::move(place);
  plot.x = std::move(x);
  plot.y = std::move(y);
  plot.series = std::move(series);
  return plot;
}

Plot bars_by_node(std::string name, std::string title, PlotAxis y, std::vector<PlotSeries> series, bool is_stacked) {
  for (PlotSeries& one : series) {
    one.mark = PlotMark::bars;
  }
  Plot plot = curves(std::move(name), std::move(title), "node", {.label = "node"}, std::move(y), std::move(series));
  plot.is_stacked = is_stacked;
  return plot;
}

Plot stacked_by_node(std::string name, std::string title, PlotAxis y, const std::vector<Column>& columns) {
  std::vector<PlotSeries> series;
  for (std::size_t i = 1; i < columns.size(); ++i) {
    series.push_back({.title = columns[i].name, .column = columns[i].name, .color = (i - 1) % plot_color_count});
  }
  return bars_by_node(std::move(name), std::move(title), std::move(y), std::move(series), true);
}

PlotAxis percent_axis(const std::string& what) { return {.label = what + " (%)", .least = 0, .most = 105}; }

}  // namespace dmpc::apps
