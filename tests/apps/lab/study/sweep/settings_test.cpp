#include "apps/lab/study/sweep/settings.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests::sweep_settings_test {

using apps::parse_variation;
using apps::SweepRun;
using apps::SweepSettings;

namespace {

SweepSettings varying(const std::vector<std::string>& variations, std::vector<std::string> fixed = {}) {
  SweepSettings settings{.scene = "balls-1", .fixed = std::move(fixed)};
  for (const std::string& variation : variations) {
    settings.variations.push_back(parse_variation(variation));
  }
  return settings;
}

std::vector<std::string> combinations(const SweepSettings& settings) {
  std::vector<std::string> texts;
  for (const SweepRun& run : apps::sweep_runs(settings)) {
    texts.push_back(apps::text_of(settings.variations, run));
  }
  return texts;
}

bool is_sweepable(const std::string& name) {
  const auto& all = apps::sweepable_options();
  return std::any_of(all.begin(), all.end(), [&](const auto& option) { return apps::long_name_of(option) == name; });
}

}  // namespace

TEST_CASE("a sweep has all combinations, and the last option changes fastest") {
  CHECK(combinations(varying({"nodes:2,3", "page-size:1KiB,4KiB"})) ==
        std::vector<std::string>{"--nodes=2 --page-size=1KiB", "--nodes=2 --page-size=4KiB", "--nodes=3 --page-size=1KiB",
                                 "--nodes=3 --page-size=4KiB"});
  CHECK(combinations(varying({"nodes:2"})).size() == 1);
}

TEST_CASE("a run is a line of render: its scene, what all have, what varies, and flags that are on") {
  const auto runs = apps::sweep_runs(varying({"count-pages:off,on", "--nodes:2"}, {"--runner=virtual"}));
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].words == std::vector<std::string>{"render", "balls-1", "--runner=virtual", "--nodes=2"});
  CHECK(runs[1].words == std::vector<std::string>{"render", "balls-1", "--runner=virtual", "--count-pages", "--nodes=2"});
  CHECK(runs[1].options.pages.count_pages);
  CHECK(runs[1].options.computer.node_count == 2);
}

TEST_CASE("a mesh file that is swept has one ray a pixel, unless something is said of that") {
  SweepSettings mesh = varying({"nodes:2"});
  mesh.scene = "a.glb";
  CHECK(apps::sweep_runs(mesh)[0].words ==
        std::vector<std::string>{"render", "a.glb", "--transport=whitted", "--samples=1", "--nodes=2"});
  CHECK_FALSE(apps::sweep_runs(mesh)[0].options.picture.transport.is_by_paths());
  mesh.fixed = {"--transport=paths"};
  CHECK(apps::sweep_runs(mesh)[0].words == std::vector<std::string>{"render", "a.glb", "--transport=paths", "--nodes=2"});
  mesh.fixed = {"--error=0.1"};
  CHECK_FALSE(apps::sweep_runs(mesh)[0].options.picture.transport.is_by_paths());
  mesh.fixed = {};
  mesh.variations.push_back(apps::parse_variation("samples:1,4"));
  CHECK(apps::sweep_runs(mesh)[1].options.picture.samples == 4);
}

TEST_CASE("how something is rendered can vary, and what is written where cannot") {
  for (const char* const name :
       {"--nodes", "--machine", "--samples", "--no-skip", "--count-pages", "--light", "--chaos", "--instances"}) {
    CHECK_MESSAGE(is_sweepable(name), name);
  }
  for (const char* const name : {"--output", "--stats", "--trace", "--quiet", "--checkpoint", "--help", "--serve"}) {
    CHECK_MESSAGE(!is_sweepable(name), name);
  }
}

TEST_CASE("a combination that render would not take is refused before anything runs, in render's words") {
  CHECK_THROWS_WITH_AS(combinations(varying({"nodes:2", "page-size:1KiB,3KiB"})),
                       doctest::Contains("with --nodes=2 --page-size=3KiB dmpc render would say: --page-size=3KiB: expected"),
                       core::UsageError);
  CHECK_THROWS_WITH_AS(combinations(varying({"machine:ipsc2"})), doctest::Contains("threads model no machine"), core::UsageError);
}

TEST_CASE("an option that is given and varied, or varied twice, is refused, and so are too many runs") {
  CHECK_THROWS_WITH_AS(combinations(varying({"nodes:2"}, {"--nodes=3"})), doctest::Contains("given, and varied"),
                       core::UsageError);
  CHECK_THROWS_WITH_AS(combinations(varying({"nodes:2", "nodes:3"})), doctest::Contains("given twice"), core::UsageError);
  std::string many = "nodes:1";
  for (int more = 2; more <= 200; ++more) {
    many += "," + std::to_string(more);
  }
  CHECK_THROWS_WITH_AS(combinations(varying({many, "depth" + many.substr(5)})), doctest::Contains("more than 10,000 runs"),
                       core::UsageError);
}

}  // namespace dmpc::tests::sweep_settings_test
