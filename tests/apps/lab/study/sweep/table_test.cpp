#include "apps/lab/study/sweep/table.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/frontend/table/plot_data.h"

namespace dmpc::tests::sweep_table_test {

using apps::Figure;
using apps::SweepResult;
using apps::SweepSettings;
using Texts = std::vector<std::string>;

namespace {

SweepSettings sweep_of(const Texts& variations, Texts columns = {}, Texts fixed = {}) {
  SweepSettings settings{.scene = "balls-1", .fixed = std::move(fixed), .columns = std::move(columns)};
  for (const std::string& variation : variations) {
    settings.variations.push_back(apps::parse_variation(variation));
  }
  return settings;
}

std::vector<SweepResult> all_with(const SweepSettings& settings, const std::vector<Figure>& figures) {
  std::vector<SweepResult> results;
  for (const apps::SweepRun& run : apps::sweep_runs(settings)) {
    results.push_back({.run = run, .figures = figures, .misfit = {}});
  }
  return results;
}

std::string csv_of(const SweepSettings& settings, const std::vector<SweepResult>& results) {
  return text_of(sweep_table(settings, apps::sweep_runs(settings), results), apps::TableFormat::csv);
}

}  // namespace

TEST_CASE("a row has what varies, sizes in bytes, and the figures with their units") {
  const SweepSettings settings = sweep_of({"page-size:1KiB", "strategy:svm"}, {"pages.faults", "seconds.render", "film_hash"});
  CHECK(
      csv_of(settings, all_with(settings, {{"pages.faults", std::uint64_t{7}}, {"seconds.render", 0.25}, {"film_hash", "0a"}})) ==
      "page-size (bytes),strategy,pages.faults,seconds.render (s),film_hash\n1024,svm,7,0.25,0a\n");
}

TEST_CASE("what a run does not have is empty, and why there was no room stands below") {
  const SweepSettings settings = sweep_of({"nodes:2,3"}, {"pages.faults"});
  std::vector<SweepResult> results = all_with(settings, {{"pages.faults", std::monostate()}});
  results[1].figures.reset();
  results[1].misfit = "3 nodes are too few";
  CHECK(csv_of(settings, results) == "nodes,pages.faults\n2,\n3,\n");
  const apps::Table table = sweep_table(settings, apps::sweep_runs(settings), results);
  CHECK(table.notes() == Texts{"No room with --nodes=3: 3 nodes are too few."});
}

TEST_CASE("a sweep over machines says once which of them have prices for other structures") {
  const auto notes = [](const std::string& structure) {
    const SweepSettings settings = sweep_of({"machine:ipsc2,ipsc2-1994", "nodes:1,2"}, {}, {"--runner=virtual", structure});
    return sweep_table(settings, apps::sweep_runs(settings), all_with(settings, {})).notes();
  };
  REQUIRE(notes("--structure=voxels").size() == 1);
  CHECK(notes("--structure=voxels")[0].starts_with("ipsc2 has prices for other structures"));
  REQUIRE(notes("--structure=grid").size() == 1);
  CHECK(notes("--structure=grid")[0].starts_with("ipsc2-1994 has prices for other structures"));
}

TEST_CASE("without columns a table has times of the runners that run, and traffic of the strategies") {
  const auto usual = [](const SweepSettings& settings) { return figures_of(settings, apps::sweep_runs(settings)); };
  CHECK(usual(sweep_of({"nodes:2"})) == Texts{"seconds.render", "rays.total", "packets.sent", "packets.bytes", "pages.faults"});
  CHECK(usual(sweep_of({"strategy:dataflow"}, {}, {"--runner=virtual"})) ==
        Texts{"virtual_seconds.total", "rays.total", "packets.sent", "packets.bytes", "travel.messages_per_ray"});
}

TEST_CASE("a picture has numbers along x and a curve for each combination of the rest") {
  const SweepSettings settings = sweep_of({"strategy:svm,forest", "nodes:2,16", "depth:1,2"}, {"packets.bytes", "film_hash"});
  const auto plots = sweep_plots(settings, apps::sweep_runs(settings));
  REQUIRE(plots.size() == 1);  // a hash is no number
  CHECK(plots[0].name == "packets-bytes");
  CHECK(plots[0].places == Texts{"nodes"});
  CHECK(plots[0].x.scale == apps::PlotScale::powers_of_2);
  REQUIRE(plots[0].series.size() == 4);
  CHECK(plots[0].series[1].title == "strategy svm, depth 2");
  CHECK(plots[0].series[1].where == std::vector<std::pair<std::string, std::string>>{{"strategy", "svm"}, {"depth", "2"}});
}

TEST_CASE("where nothing varies by numbers a picture has bars, and more curves than can be told apart are not drawn") {
  const SweepSettings words = sweep_of({"strategy:svm,forest"}, {"packets.bytes"});
  const auto bars = sweep_plots(words, apps::sweep_runs(words));
  REQUIRE(bars.size() == 1);
  CHECK(bars[0].series[0].mark == apps::PlotMark::bars);
  const SweepSettings many = sweep_of({"nodes:1,2", "depth:1,2,3,4,5,6,7,8,9,10,11,12,13"}, {"packets.bytes"});
  CHECK(sweep_plots(many, apps::sweep_runs(many)).empty());
}

TEST_CASE("the table of a sweep can be drawn as plots") {
  const SweepSettings settings = sweep_of({"page-size:1KiB,4KiB", "strategy:svm,replicated"}, {"packets.bytes"});
  const auto runs = apps::sweep_runs(settings);
  const apps::Table table = sweep_table(settings, runs, all_with(settings, {{"packets.bytes", std::uint64_t{7}}}));
  for (const apps::Plot& plot : sweep_plots(settings, runs)) {
    CHECK(plot_data(plot, table).has_value());
  }
}

}  // namespace dmpc::tests::sweep_table_test
