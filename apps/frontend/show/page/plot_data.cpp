#include "apps/frontend/show/page/plot_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/system/base64.h"
#include "apps/frontend/table/drawn_plot.h"
#include "core/base/expect.h"

namespace dmpc::apps::html {

namespace {

using nlohmann::json;

/// By PlotMark.
constexpr std::array<const char*, 5> mark_names = {"line", "points", "bars", "intervals", "bands"};

json axis_of(const std::string& label, const Column& column) {
  return {{"label", label}, {"unit", column.unit}, {"digits", column.digits}};
}

json json_of(const std::vector<Tick>& ticks) {
  json all = json::array();
  for (const Tick& tick : ticks) {
    all.push_back({tick.position, tick.text});
  }
  return all;
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

/// Round times within a map's columns.
std::vector<Tick> column_ticks(const NumberMap& map, double column_ns) {
  std::vector<Tick> ticks = amount_ticks(0, column_ns * static_cast<double>(map.columns), false, "ns");
  for (Tick& tick : ticks) {
    tick.position /= column_ns;
  }
  return ticks;
}

/// Numbers that are counted have no halves.
std::vector<Tick> scale_ticks(double most, const std::string& unit) {
  std::vector<Tick> ticks = amount_ticks(0, most, false, unit);
  std::erase_if(ticks, [&](const Tick& tick) { return unit.empty() && tick.position != std::floor(tick.position); });
  return ticks;
}

std::string levels_of(const std::vector<double>& values, double most) {
  std::string levels;
  for (const double value : values) {
    levels += static_cast<char>(most > 0 ? std::min(255.0, std::ceil(255 * value / most)) : 0);
  }
  return base64(levels);
}

std::string text_of(const json& data) { return data.dump(-1, ' ', true, json::error_handler_t::replace); }

}  // namespace

std::optional<std::string> plot_data(const Plot& plot, const Table& table) {
  const DrawnPlot drawn(plot, table);
  if (drawn.series().empty()) {
    return std::nullopt;
  }
  const auto column = [&table](const std::string& name) -> const Column& {
    return table.columns()[number_of_column(table, name)];
  };
  const Column &x = column(plot.places.front()), &y = column(drawn.series().front()->column);
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

std::string map_data(const NumberMap& map) {
  core::expect(map.values.size() == map.rows * map.columns && !map.values.empty(), "a map of numbers has one for each place");
  const double most = map.most.value_or(*std::max_element(map.values.begin(), map.values.end()));
  json data = {{"title", map.title},
               {"row_label", map.row_label},
               {"column_label", map.column_label},
               {"value_label", map.value_label},
               {"rows", map.rows},
               {"columns", map.columns},
               {"most", most},
               {"ticks", json_of(scale_ticks(most, map.unit))}};
  if (map.column_ns) {
    data["column_ticks"] = json_of(column_ticks(map, *map.column_ns));
    data["column_ms"] = *map.column_ns / 1e6;
  }
  if (map.values.size() <= exact_numbers_max) {
    data["values"] = map.values;
  } else {
    data["levels"] = levels_of(map.values, most);
  }
  return text_of(data);
}

}  // namespace dmpc::apps::html
