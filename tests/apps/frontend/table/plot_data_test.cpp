#include "apps/frontend/table/plot_data.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "core/base/expect.h"

namespace dmpc::apps::plot_data_test {

namespace {

using nlohmann::json;

Table times() {
  Table table("Times", {{"nodes"}, {"time", "ms", 1}, {"low", "ms"}, {"unknown", "ms"}});
  table.add_row({std::uint64_t{1}, 8.0, 7.0, {}});
  table.add_row({std::uint64_t{4}, 2.0, 1.0, {}});
  table.add_row({std::uint64_t{4}, {}, {}, {}});
  return table;
}

json data_of(const Plot& plot) { return json::parse(plot_data(plot, times()).value()); }

}  // namespace

TEST_CASE("bars have names of places, in the table's order and without those that have no bar, and their numbers") {
  Plot plot = bars_by_node("times", "Times", {.label = "t", .least = 0}, {{"time", "time"}});
  plot.place = "nodes";
  const json data = data_of(plot);
  CHECK(data["bars"] == true);
  CHECK(data["places"] == json({"1", "4"}));
  CHECK(data["series"][0]["rows"] == json({{0.0, 8.0}, {1.0, 2.0}}));
  CHECK(data["series"][0]["unit"] == "ms");
  CHECK(data["series"][0]["mark"] == "bars");
  CHECK(data["y"]["least"] == 0.0);
  CHECK(data["y"]["most"].get<double>() > 8);
  CHECK(data["y"]["ticks"][0] == json({0.0, "0"}));
}

TEST_CASE("curves have limits and ticks along both axes") {
  const Plot plot = curves("times", "Times", "nodes", {.label = "nodes"}, {.label = "t", .scale = PlotScale::powers_of_10},
                           {{.title = "a", .column = "time"}});
  const json data = data_of(plot);
  CHECK_FALSE(data.contains("places"));
  CHECK(data["series"][0]["rows"] == json({{1.0, 8.0}, {4.0, 2.0}}));
  CHECK(data["x"]["log"] == false);
  CHECK(data["y"]["log"] == true);
  CHECK(data["x"]["least"] == 1.0);
  CHECK(data["x"]["most"] == 4.0);
  CHECK(data["x"]["ticks"].size() > 1);
  CHECK(data["y"]["least"].get<double>() < 2);
  CHECK(data["y"]["most"].get<double>() > 8);
}

TEST_CASE("bars over time stand at their numbers, each as wide as a step") {
  Plot plot = curves("times", "Times", "nodes", {}, {.label = "t", .least = 0},
                     {{.title = "time", .column = "time", .mark = PlotMark::bars}});
  plot.bar_width = 2.5;
  const json data = data_of(plot);
  CHECK_FALSE(data.contains("places"));
  CHECK(data["width"] == 2.5);
  CHECK(data["x"]["most"] == 6.5);
  CHECK(data["series"][0]["rows"] == json({{1.0, 8.0}, {4.0, 2.0}}));
}

TEST_CASE("a series without a row is left out, and one without a number above 0 on a logarithmic axis") {
  Plot plot = curves("times", "Times", "nodes", {}, {}, {{"a", "time"}, {"b", "unknown"}});
  CHECK(data_of(plot)["series"].size() == 1);
  Table table = times();
  table.add_row({std::uint64_t{8}, 1.0, 1.0, 0.0});
  CHECK(json::parse(plot_data(plot, table).value())["series"].size() == 2);
  plot.y.scale = PlotScale::powers_of_10;
  CHECK(json::parse(plot_data(plot, table).value())["series"].size() == 1);
}

TEST_CASE("a plot of no row has no data") {
  Plot plot = curves("times", "Times", "nodes", {}, {}, {{"b", "unknown"}});
  CHECK_FALSE(plot_data(plot, times()).has_value());
  plot.series.clear();
  CHECK_FALSE(plot_data(plot, times()).has_value());
}

TEST_CASE("a plot of what the table has not, of too many colours, or of bars and curves is a mistake") {
  const auto is_refused = [](const Plot& plot) { CHECK_THROWS_AS(plot_data(plot, times()), core::InternalError); };
  const Plot right = curves("times", "Times", "nodes", {}, {}, {{"time", "time"}, {"low", "low"}});
  CHECK_NOTHROW(plot_data(right, times()));
  Plot plot = right;
  plot.series[0].column = "speed";
  is_refused(plot);
  plot = right;
  plot.series[0].color = plot_color_count;
  is_refused(plot);
  plot = right;
  plot.series[0].mark = PlotMark::bars;
  is_refused(plot);
}

}  // namespace dmpc::apps::plot_data_test
