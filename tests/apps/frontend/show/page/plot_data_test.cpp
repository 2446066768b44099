#include "apps/frontend/show/page/plot_data.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/frontend/system/base64.h"
#include "core/base/expect.h"

namespace dmpc::apps::html::plot_data_test {

namespace {

using nlohmann::json;

Table times() {
  Table table("Times", {{"scene"}, {"nodes"}, {"time", "ms", 1}, {"low", "ms"}, {"high", "ms"}});
  table.add_row({"a", std::uint64_t{1}, 8.0, 7.0, 9.0});
  table.add_row({"a", std::uint64_t{4}, 2.0, 1.0, 3.0});
  table.add_row({"b", std::uint64_t{4}, {}, {}, {}});
  return table;
}

json data_of(const Plot& plot) { return json::parse(plot_data(plot, times()).value()); }

}  // namespace

TEST_CASE("bars have names of places, in the table's order and without those that have no bar, and their numbers") {
  Plot plot = bars_by_node("times", "Times", {.label = "t", .least = 0}, {{"time", "time"}});
  plot.places = {"nodes"};
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

TEST_CASE("curves have limits and ticks along both axes, at powers of two where they are asked for") {
  const Plot plot = curves(
      "times", "Times", "nodes", {.label = "nodes", .scale = PlotScale::powers_of_2},
      {.label = "t", .scale = PlotScale::powers_of_10},
      {{.title = "a", .column = "time", .where = {{"scene", "a"}}, .mark = PlotMark::intervals, .low = "low", .high = "high"}});
  const json data = data_of(plot);
  CHECK_FALSE(data.contains("places"));
  CHECK(data["series"][0]["rows"] == json({{1.0, 8.0, 7.0, 9.0}, {4.0, 2.0, 1.0, 3.0}}));
  CHECK(data["x"]["log"] == true);
  CHECK(data["x"]["least"] == 1.0);
  CHECK(data["x"]["most"] == 4.0);
  CHECK(data["x"]["ticks"] == json({{1.0, "1"}, {2.0, "2"}, {4.0, "4"}}));
  CHECK(data["y"]["least"].get<double>() < 1);
  CHECK(data["y"]["most"].get<double>() > 9);
}

TEST_CASE("a map of few numbers has them, and a scale without halves where they are counted") {
  NumberMap map{.title = "Who",
                .row_label = "row",
                .column_label = "column",
                .value_label = "fetches",
                .unit = {},
                .rows = 1,
                .columns = 2,
                .values = {0, 2}};
  json data = json::parse(map_data(map));
  CHECK(data["values"] == json({0.0, 2.0}));
  CHECK(data["most"] == 2.0);
  for (const json& tick : data["ticks"]) {
    CHECK(tick[0].get<double>() == std::floor(tick[0].get<double>()));
  }
  CHECK_FALSE(data.contains("column_ticks"));
  map.column_ns = 5'000'000;
  map.unit = "%";
  map.most = 1;
  data = json::parse(map_data(map));
  CHECK(data["column_ticks"].back() == json({2.0, "10 ms"}));
  CHECK(data["most"] == 1.0);
  map.values.clear();
  CHECK_THROWS_AS(map_data(map), core::InternalError);
}

TEST_CASE("a map of many numbers has them in 255ths of the largest, and none but 0 becomes 0") {
  NumberMap map{.title = "Who", .row_label = {}, .column_label = {}, .value_label = {}, .unit = {}, .rows = 1, .columns = 4098};
  map.values.assign(4095, 1000);
  map.values.insert(map.values.begin(), {0, 1, 500});
  const json data = json::parse(map_data(map));
  CHECK_FALSE(data.contains("values"));
  CHECK(data["levels"].get<std::string>().substr(0, 4) == base64(std::string("\0\1\200", 3)));
}

TEST_CASE("a plot of nothing has no data") {
  const Plot plot = curves("times", "Times", "nodes", {}, {}, {{"b", "time", {{"scene", "b"}}}});
  CHECK_FALSE(plot_data(plot, times()).has_value());
}

}  // namespace dmpc::apps::html::plot_data_test
