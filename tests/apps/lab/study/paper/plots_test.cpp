#include "apps/lab/study/paper/report.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "apps/lab/study/paper/sensitivity.h"
#include "apps/lab/study/paper/tables.h"
#include "tests/support/paper_results.h"
#include "tests/support/text.h"

namespace dmpc::tests::plots_test {

using namespace apps;

namespace {

const Plot& plot_named(const std::vector<PaperPlot>& plots, const std::string& name) {
  const auto found = std::find_if(plots.begin(), plots.end(), [&](const PaperPlot& plot) { return plot.plot.name == name; });
  REQUIRE(found != plots.end());
  return found->plot;
}

/// Whole, of results that are all alike.
std::map<std::string, Table> drawn_tables() {
  Catalogue catalogue = catalogue_of(16);
  const std::vector<VariedRuns> varied = add_variations(catalogue);
  const PaperResults results = all_alike(catalogue);
  Table pages("", {{"scene"}, {"pages a pixel printed"}, {"pages a pixel"}});
  pages.add_row({"Teapot", 58.19, 34.63});
  return {{"table_2", std::move(pages)},          {"table_3", table_3(catalogue, results)},
          {"losses", losses(catalogue, results)}, {"algorithms", algorithms(catalogue, results)},
          {"caches", caches(catalogue, results)}, {"sensitivity", sensitivity(catalogue, results, varied)}};
}

}  // namespace

TEST_CASE("every picture of the study has files of its own, a title, and axes with labels") {
  std::set<std::string> names;
  for (const PaperPlot& plot : paper_plots()) {
    CAPTURE(plot.plot.name);
    CHECK(names.insert(plot.plot.name).second);
    CHECK_FALSE(plot.plot.title.empty());
    CHECK_FALSE(plot.plot.y.label.empty());
    const bool is_bars = plot.plot.series.front().mark == PlotMark::bars;  // their places have names in place of a label
    CHECK(plot.plot.x.label.empty() == is_bars);
  }
}

TEST_CASE("every picture of the study is of columns and rows that its table has") {
  const std::map<std::string, Table> tables = drawn_tables();
  CHECK(paper_plots().size() == 9);
  for (const PaperPlot& plot : paper_plots()) {
    CAPTURE(plot.plot.name);
    REQUIRE(tables.contains(plot.table));
    const std::string script = script_of(plot.plot, tables.at(plot.table), "data.csv").value_or("");
    CHECK(count(script, " title ") == plot.plot.series.size() + 1);  // that of the picture, too
  }
}

TEST_CASE("what is changed by other than a fifth is not in the picture of the sensitivity") {
  const std::vector<PaperPlot> plots = paper_plots();
  const std::string script =
      script_of(plot_named(plots, "sensitivity"), drawn_tables().at("sensitivity"), "data.csv").value_or("");
  CHECK(script.find("'cached look-up'") != std::string::npos);
  CHECK(script.find("'home look-up'") == std::string::npos);
  CHECK(script.find("'contention for links'") == std::string::npos);
}

TEST_CASE("Table 3 is drawn as points where it is printed and as lines where it is found, of one colour a scene") {
  const Catalogue catalogue = catalogue_of(16);
  const std::vector<PaperPlot> plots = paper_plots();
  for (const auto& [name, scenes] : {std::pair("table_3", 4U), {"table_3_seconds", 5U}}) {  // Tetra10 has no efficiency
    const Plot& plot = plot_named(plots, name);
    const std::string script = script_of(plot, table_3(catalogue, as_printed(catalogue)), "table_3.csv").value_or("");
    CHECK(count(script, " with points") == scenes);
    CHECK(count(script, " with linespoints") == scenes);
    for (std::size_t series = 0; series < plot.series.size(); series += 2) {
      CHECK(plot.series[series].color == plot.series[series + 1].color);
      CHECK(plot.series[series].where == plot.series[series + 1].where);
    }
  }
}

TEST_CASE("the losses of Table 3 are stacked, a bar a cell") {
  const Catalogue catalogue = catalogue_of(16);
  const std::vector<PaperPlot> plots = paper_plots();
  const std::string script =
      script_of(plot_named(plots, "losses"), losses(catalogue, as_printed(catalogue)), "losses.csv").value_or("");
  CHECK(script.find("array names[24]") != std::string::npos);
  CHECK(count(script, " with boxes") == 12);  // ten parts, of which two take colours for the second time, under a hatch
}

}  // namespace dmpc::tests::plots_test
