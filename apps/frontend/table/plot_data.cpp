#include "apps/frontend/table/plot_data.h"

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/frontend/table/drawn_plot.h"

namespace dmpc::apps {

namespace {

using nlohmann::json;

/// By PlotMark.
constexpr std::array<const char*, 4> mark_names = {"line", "points", "bars", "bands"};

json axis_of(const std::string& label, const Column& column) {
  return {{"label", label}, {"unit", column.unit}, {"digits", column.digits}};
}

json axis_of(const PlotAxis& axis, const Column& column, const ShownAxis& shown) {
  json made = axis_of(axis.label, column);
  made.update(
      {{"log", axis.scale != PlotScale::linear}, {"least", shown.least}, {"most", shown.most}, {"ticks", json_of(shown.ticks)}});
  return made;
}

json row_of(const DrawnPlot& drawn, const PlotSeries& series, const std::vector<Cell>& row) {
  json numbers = json::array({drawn.x_of(row), drawn.number_in(row, series.column)});
  for (const std::string* const end : {&series.low, &series.high, &series.box_low, &series.box_high}) {
    if (!end->empty()) {
      numbers.push_back(drawn.number_in(row, *end));
    }
  }
  return numbers;
}

std::string text_of(const json& data) { return data.dump(-1, ' ', true, json::error_handler_t::replace); }

}  // namespace

json json_of(const std::vector<Tick>& ticks) {
  json all = json::array();
  for (const Tick& tick : ticks) {
    all.push_back({tick.position, tick.text});
  }
  return all;
}

std::optional<std::string> plot_data(const Plot& plot, const Table& table) {
  const DrawnPlot drawn(plot, table);
  if (drawn.series().empty()) {
    return std::nullopt;
  }
  const auto column = [&table](const std::string& name) -> const Column& {
    return table.columns()[number_of_column(table, name)];
  };
  const Column &x = column(plot.place), &y = column(drawn.series().front()->column);
  json data = {{"title", plot.title},           {"bars", drawn.is_bars()},
               {"stacked", plot.is_stacked},    {"width", plot.bar_width.value_or(0)},
               {"x", axis_of(plot.x.label, x)}, {"y", axis_of(plot.y, y, shown_axis(plot.y, drawn.span_of_y(), y.unit, true))},
               {"series", json::array()}};
  if (drawn.has_places()) {
    data["places"] = drawn.places();
  } else {
    data["x"] = axis_of(plot.x, x, shown_axis(plot.x, drawn.span_of_x(), x.unit, false));
  }
  for (const PlotSeries* const series : drawn.series()) {
    json rows = json::array();
    for (const std::vector<Cell>& row : table.rows()) {
      if (drawn.is_meant(*series, row)) {
        rows.push_back(row_of(drawn, *series, row));
      }
    }
    data["series"].push_back({{"name", series->title},
                              {"color", series->color},
                              {"mark", mark_names.at(static_cast<std::size_t>(series->mark))},
                              {"unit", column(series->column).unit},
                              {"digits", column(series->column).digits},
                              {"rows", std::move(rows)}});
  }
  return text_of(data);
}

}  // namespace dmpc::apps
