#include "apps/frontend/table/plot.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "apps/frontend/show/page/web_part.h"
#include "core/base/expect.h"
#include "tests/support/text.h"

namespace dmpc::tests::plot_test {

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
  CHECK(contains(text,
                 "set ylabel 'time (s)'\nset yrange [*:20.8]\nset ytics ('0' 0, '5 s' 5, '10 s' 10, '15 s' 15, '20 s' 20)\n"));
  CHECK_FALSE(contains(text, "logscale y"));
  CHECK(contains(text,
                 "'t.csv' using (column('nodes')):(stringcolumn('scene') eq 'a' ? column('time (s)') : NaN) smooth unique with "
                 "linespoints"));
  CHECK(contains(text, "(stringcolumn('scene') eq 'a' ? column('loss (%)') : NaN) with points"));
}

TEST_CASE("texts cannot end their quotes or lines") {
  Plot plot = curves();
  plot.title = "'first'";
  CHECK(contains(script(plot), "set title \"'\".'first'''\n"));
  plot.title = "a''b'";
  CHECK(contains(script(plot), "set title 'a'.\"'\".\"'\".'b'''\n"));
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
  plot.series[0].color = 12;
  is_refused(plot);
  plot = curves();
  plot.series[0].mark = PlotMark::bars;
  is_refused(plot);
  plot = curves();
  plot.places = {"nodes", "scene"};
  is_refused(plot);
  plot = bars(false);
  plot.places = {"remark"};
  Table two_lines("Times", small_times().columns());
  two_lines.add_row({"a", std::uint64_t{1}, 8.0, 0.0, "x\ny"});
  CHECK_THROWS_AS(script_of(plot, two_lines, "t.csv"), core::InternalError);
}

TEST_CASE("rows and places whose names CSV has to quote, which gnuplot would cut, are known by their rows") {
  Table table("Regions", {{"nodes"}, {"regions"}, {"load", "%", 1}});
  for (const char* regions : {"cut", "cut, by turns", "so \"even\""}) {
    table.add_row({std::uint64_t{4}, regions, 50.0});
  }
  Plot lines = apps::curves("load", "Load", "nodes", {}, {}, {{"by turns", "load", {{"regions", "cut, by turns"}}}});
  const std::string text = script(lines, table);
  CHECK(contains(text, "array texts2[3] = ['cut', 'cut, by turns', 'so \"even\"']\n"));
  CHECK(contains(text, "(texts2[int(column(0)) + 1] eq 'cut, by turns' ? column('load (%)') : NaN)"));
  Plot bars = apps::curves("load", "Load", "regions", {}, {}, {{.title = "load", .column = "load", .mark = PlotMark::bars}});
  CHECK(contains(script(bars, table), "using (place_of(texts2[int(column(0)) + 1])):"));
}

TEST_CASE("a place of bars may have percents in its name") {
  Table table("Caches", {{"cache"}, {"time", "s", 1}});
  table.add_row({"5 %", 1.0});
  const Plot plot =
      apps::curves("caches", "Caches", "cache", {}, {}, {{.title = "time", .column = "time", .mark = PlotMark::bars}});
  CHECK(contains(script(plot, table), "array names[1] = ['5 %']"));
  CHECK(contains(script(plot, table), "('5 %%' 1)"));
}

TEST_CASE("axes have round ticks in units that people read") {
  Table table("Sizes", {{"nodes"}, {"sent", "bytes"}});
  table.add_row({std::uint64_t{1}, std::uint64_t{105'000'000}});
  table.add_row({std::uint64_t{1500}, std::uint64_t{1'200'000}});
  const Plot plot = apps::curves("sizes", "Sizes", "nodes", {}, {.label = "", .least = 0}, {{"sent", "sent"}});
  const std::string text = script(plot, table);
  CHECK(contains(text, "set yrange [0:1.092e+08]\nset ytics ('0' 0, '20 MB' 2e+07, '40 MB' 4e+07"));
  CHECK(contains(text, "set xtics ('500' 500, '1,000' 1000, '1,500' 1500)"));
}

TEST_CASE("bars over time stand at their numbers, each to the right of its own") {
  Table table("Steps", {{"start", "ms", 1}, {"work", "%", 1}});
  for (const double start : {0.0, 2.5, 5.0}) {
    table.add_row({start, 50.0});
  }
  Plot plot = apps::curves("steps", "Steps", "start", {}, {.label = "%", .least = 0},
                           {{.title = "work", .column = "work", .mark = PlotMark::bars}});
  plot.bar_width = 2.5;
  const std::string text = script(plot, table);
  CHECK(contains(text, "using (column('start (ms)') + 1.25):"));
  CHECK(contains(text, "set boxwidth 2.5\n"));
  CHECK(contains(text, "set xtics ('0' 0, '2 ms' 2, '4 ms' 4, '6 ms' 6)"));
}

TEST_CASE("twelve series look unlike: in colour, or dashed, or hatched") {
  std::vector<Column> columns = {{"x"}};
  std::vector<Cell> row = {std::uint64_t{1}};
  std::vector<PlotSeries> lines, blocks;
  for (std::size_t i = 0; i < plot_color_count; ++i) {
    columns.push_back({"y" + std::to_string(i)});
    row.emplace_back(1.0);
    lines.push_back({.title = "same", .column = columns.back().name, .color = i});
    blocks.push_back({.title = "same", .column = columns.back().name, .mark = PlotMark::bars, .color = i});
  }
  Table wide("Wide", columns);
  wide.add_row(row);
  for (const std::vector<PlotSeries>& series : {lines, blocks}) {
    std::set<std::string> looks;
    std::istringstream text(script(apps::curves("wide", "Wide", "x", {}, {}, series), wide));
    for (std::string line; std::getline(text, line);) {
      if (const std::size_t at = line.find(" with "); at != std::string::npos && !contains(line, "notitle")) {
        looks.insert(line.substr(at, line.find(" title ") - at));
      }
    }
    CHECK(looks.size() == plot_color_count);
  }
}

TEST_CASE("a hatched bar hides what lies under it") {
  Plot plot = bars(true);
  plot.series[1].color = 8;
  const std::string text = script(plot);
  const std::size_t ground = text.find("with boxes linecolor '#eeeeee' notitle");
  CHECK(ground < text.find("with boxes linecolor '#0072B2' fillstyle pattern 4 title 'loss'"));
  CHECK(text.find("fillstyle pattern 4") < text.find("title 'time'"));
}

namespace {

using Light = std::array<double, 3>;

/// The light of "#rrggbb".
Light linear_light(const std::string& color) {
  Light light{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double value = std::stoi(color.substr(1 + 2 * channel, 2), nullptr, 16) / 255.0;
    light[channel] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  }
  return light;
}

Light seen_by(const std::array<Light, 3>& matrix, const Light& light) {
  Light product{};
  for (std::size_t row = 0; row < 3; ++row) {
    product[row] = matrix[row][0] * light[0] + matrix[row][1] * light[1] + matrix[row][2] * light[2];
  }
  return product;
}

/// CIE 1976 L*a*b* under D65.
Light lab(Light light) {
  for (double& value : light) {
    value = std::clamp(value, 0.0, 1.0);
  }
  Light xyz = seen_by({{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}}, light);
  xyz[0] /= 0.9505;
  xyz[2] /= 1.089;
  const auto curve = [](double value) { return value > 0.008856 ? std::cbrt(value) : 7.787 * value + 16.0 / 116; };
  return {116 * curve(xyz[1]) - 16, 500 * (curve(xyz[0]) - curve(xyz[1])), 200 * (curve(xyz[1]) - curve(xyz[2]))};
}

/// Those of palette.js.
std::vector<std::string> page_colors() {
  const std::string script = html::page_script.text;
  std::size_t at = script.find("seriesColors = ["), end = script.find(']', at);
  std::vector<std::string> colors;
  while ((at = script.find('#', at)) < end) {
    colors.push_back(script.substr(at, 7));
    ++at;
  }
  return colors;
}

double color_distance(const Light& a, const Light& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

// The matrices of G. Machado, M. Oliveira, L. Fernandes, "A Physiologically-based Model for Simulation of Color Vision
// Deficiency" (2009), for the strongest degree of each.
TEST_CASE("people who lack one kind of cones can tell the colours of plots apart") {
  constexpr double clearly_apart = 15;  // a difference of 2.3 is just seen
  const std::array<std::array<Light, 3>, 4> eyes = {{
      {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
      {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
      {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}},
  }};
  for (const std::vector<std::string>& colors :
       {std::vector<std::string>(plot_colors.begin(), plot_colors.end()), page_colors()}) {
    REQUIRE(colors.size() == 8);
    for (const auto& eye : eyes) {
      for (std::size_t a = 0; a < colors.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          CAPTURE(colors[a]);
          CAPTURE(colors[b]);
          CHECK(color_distance(lab(seen_by(eye, linear_light(colors[a]))), lab(seen_by(eye, linear_light(colors[b])))) >
                clearly_apart);
        }
      }
    }
  }
}

}  // namespace dmpc::tests::plot_test
