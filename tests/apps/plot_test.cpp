#include "apps/plot.h"

#include <doctest/doctest.h>

#include <string>

#include "core/expect.h"
#include "tests/support/text.h"

namespace dmpc::tests {

using namespace apps;

namespace {

/// Two scenes on two machines, and a figure that is missing.
Table small_times() {
  Table table("Times", {{"scene"}, {"nodes"}, {"time", "s", 1}, {"loss", "%", 1}, {"remark"}});
  table.add_row({"a", std::uint64_t{1}, 8.0, 0.0, "x, y"});
  table.add_row({"a", std::uint64_t{2}, 5.0, 20.0, "x, y"});
  table.add_row({"b", std::uint64_t{1}, {}, 1.0, "x, y"});
  return table;
}

Plot curves() {
  return {.name = "times",
          .title = "Ours and theirs",
          .places = {"nodes"},
          .x = {.label = "nodes", .scale = PlotScale::powers_of_2, .least = 0.9, .most = 72},
          .y = {.label = "time (s)"},
          .series = {{"a's time", "time", {{"scene", "a"}}, PlotMark::line, 0},
                     {"a's loss", "loss", {{"scene", "a"}}, PlotMark::points, 1}}};
}

Plot bars(bool is_stacked) {
  return {.name = "bars",
          .title = "Bars",
          .places = {"scene", "nodes"},
          .x = {},
          .y = {.label = "s"},
          .series = {{"time", "time", {}, PlotMark::bars, 0}, {"loss", "loss", {}, PlotMark::bars, 1}},
          .is_stacked = is_stacked};
}

std::string script(const Plot& plot, const Table& table = small_times()) { return script_of(plot, table, "t.csv").value_or(""); }
}  // namespace

TEST_CASE("a script names its files, its axes and their scales") {
  const std::string text = script(curves());
  CHECK(contains(text, "set output 'times.svg'"));
  CHECK(contains(text, "background '#ffffff'"));
  CHECK(contains(text, "set xlabel 'nodes'\nset xrange [0.9:72]\nset logscale x 2\n"));
  CHECK(contains(text, "set ylabel 'time (s)'\nset yrange [*:*]\n"));
  CHECK_FALSE(contains(text, "logscale y"));
  CHECK(contains(text,
                 "'t.csv' using (column('nodes')):(stringcolumn('scene') eq 'a' ? column('time (s)') : NaN) smooth unique with "
                 "linespoints"));
  CHECK(contains(text, "(stringcolumn('scene') eq 'a' ? column('loss (%)') : NaN) with points"));
}

TEST_CASE("texts cannot end their quotes or lines") {
  Plot plot = curves();
  plot.title = "it's\n\"new\"";
  CHECK(contains(script(plot), "set title 'it''s \"new\"'\n"));
  CHECK(contains(script(plot), "title 'a''s time'"));
}

TEST_CASE("places of bars are named by their columns, in the table's order and without those that have no bar") {
  CHECK(contains(script(bars(false)), "array names[3] = ['a 1', 'a 2', 'b 1']"));
  Plot plot = bars(false);
  plot.series.pop_back();
  CHECK(contains(script(plot), "array names[2] = ['a 1', 'a 2']"));
}

TEST_CASE("bars of one place stand side by side about its middle, stacked ones upon one another from the top down") {
  const std::string beside = script(bars(false)), stacked = script(bars(true));
  CHECK(contains(beside, "set boxwidth 0.4\n"));
  CHECK(contains(beside, " + -0.2):(column('time (s)')) with boxes"));
  CHECK(contains(beside, " + 0.2):(column('loss (%)')) with boxes"));
  CHECK(contains(stacked, "set boxwidth 0.8\n"));
  CHECK(stacked.find("(column('time (s)') + column('loss (%)')) with boxes") < stacked.find("(column('time (s)')) with boxes"));
}

TEST_CASE("a logarithmic axis leaves a series out that has nothing above 0") {
  Plot plot = curves();
  plot.y.scale = PlotScale::powers_of_10;
  plot.series[1].where = {{"scene", "a"}, {"nodes", "4"}};
  Table table = small_times();
  table.add_row({"a", std::uint64_t{4}, 3.0, 0.0, "x, y"});
  CHECK_FALSE(contains(script(plot, table), "a''s loss"));
  plot.y.scale = PlotScale::linear;
  CHECK(contains(script(plot, table), "a''s loss"));
}

TEST_CASE("a series without a row is left out, and without any series there is no script") {
  Plot plot = curves();
  plot.series[1].where = {{"scene", "nobody"}};
  CHECK(contains(script(plot), "a''s time"));
  CHECK_FALSE(contains(script(plot), "a''s loss"));
  plot.series.erase(plot.series.begin());
  CHECK_FALSE(script_of(plot, small_times(), "t.csv").has_value());
  CHECK_FALSE(script_of(curves(), Table("", small_times().columns()), "t.csv").has_value());
  plot.series.clear();
  CHECK_FALSE(script_of(plot, small_times(), "t.csv").has_value());
}

TEST_CASE("a plot of what the table has not, of too many colours, or of bars and curves is a mistake") {
  const auto is_refused = [](const Plot& plot) { CHECK_THROWS_AS(script_of(plot, small_times(), "t.csv"), core::InternalError); };
  Plot plot = curves();
  plot.series[0].column = "speed";
  is_refused(plot);
  plot = curves();
  plot.series[0].color = 8;
  is_refused(plot);
  plot = curves();
  plot.series[0].mark = PlotMark::bars;
  is_refused(plot);
  plot = curves();
  plot.places = {"nodes", "scene"};
  is_refused(plot);
  plot = bars(false);
  plot.places = {"remark"};  // has a comma
  is_refused(plot);
}

TEST_CASE("a small plot has its legend below, and none for a single series") {
  Plot plot = curves();
  CHECK(contains(script(plot), "svg size 960,600"));
  CHECK(contains(script(plot), "set key outside right top"));
  plot.size = PlotSize::small;
  CHECK(contains(script(plot), "svg size 480,288"));
  CHECK(contains(script(plot), "set key bmargin"));
  plot.series.pop_back();
  CHECK(contains(script(plot), "set key off"));
}

TEST_CASE("a small plot of many bars names every so many") {
  Table table("Many", {{"node"}, {"time", "s", 1}});
  for (std::uint64_t node = 0; node < 30; ++node) {
    table.add_row({node, 1.0});
  }
  Plot plot = apps::curves("many", "Many", "node", {}, {}, {{.title = "time", .column = "time", .mark = PlotMark::bars}});
  CHECK(contains(script(plot, table), "'28' 29, '29' 30)"));
  plot.size = PlotSize::small;
  CHECK(contains(script(plot, table), "'26' 27, '28' 29)"));
}

}  // namespace dmpc::tests
