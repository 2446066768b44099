#include "apps/lab/study/paper/runs.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "apps/frontend/machine/machines.h"
#include "apps/lab/study/paper/data.h"
#include "core/base/expect.h"
#include "core/families/scenes.h"
#include "tests/support/paper_results.h"

namespace dmpc::tests::paper_runs_test {

using namespace apps;

namespace {

std::vector<PaperRun> small_runs() {
  const PaperRun like{.scene = "tetra-3", .machine = find_machine_preset("ipsc2")->machine, .resolution = 16};
  std::vector<PaperRun> runs(3, like);
  runs[1].node_count = 4;
  runs[2].node_count = 4;
  runs[2].strategy = Strategy::dataflow;
  return runs;
}

}  // namespace

TEST_CASE("the article's scenes have ours, and times from some column on") {
  for (const PaperScene& paper : paper_scenes) {
    CAPTURE(paper.title);
    CHECK(core::find_scene_name(paper.scene).has_value());
    CHECK(std::all_of(paper.seconds.begin() + static_cast<std::ptrdiff_t>(paper.base()), paper.seconds.end(),
                      [](std::uint32_t seconds) { return seconds > 0; }));
    CHECK(std::is_sorted(paper.seconds.rbegin(), paper.seconds.rend() - static_cast<std::ptrdiff_t>(paper.base())));
  }
  CHECK(paper_scenes[2].base() == 1);
  CHECK(100.0 * paper_scenes[0].seconds[0] / (64.0 * paper_scenes[0].seconds[6]) == doctest::Approx(90.0).epsilon(0.001));
}

TEST_CASE("the runs of a study give one film, and more nodes are quicker") {
  const std::vector<PaperRun> runs = small_runs();
  const std::vector<PaperSubject> subjects = paper_subjects(runs);
  CHECK(subjects.size() == 1);
  const PaperResults results = carried_out(runs, subjects);
  REQUIRE(results.size() == 3);
  REQUIRE((results[0] && results[1] && results[2]));
  CHECK(results[1]->total_ns < results[0]->total_ns);
  CHECK(results[2]->film_hash == results[0]->film_hash);
  CHECK(results[0]->faults == 0);
  CHECK(results[1]->faults > 0);
  CHECK(results[1]->parts.total_ns() == 4 * results[1]->total_ns);
  CHECK(results[1]->references > results[1]->faults);
  CHECK(results[1]->tests == results[0]->tests);
  CHECK(results[2]->average_load > 0);
  CHECK(results[2]->average_load <= 1);
}

TEST_CASE("the runs of a study take the same virtual time every time") {
  const std::vector<PaperRun> runs = small_runs();
  const std::vector<PaperSubject> subjects = paper_subjects(runs);
  const PaperResults first = carried_out(runs, subjects), second = carried_out(runs, subjects);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    CHECK(first[i]->total_ns == second[i]->total_ns);
  }
}

TEST_CASE("a cache of a share of the database has so many pages, and at least one; one of so many pages has so many") {
  std::vector<PaperRun> runs(3, {.scene = "tetra-4", .node_count = 4, .machine = paper_machine(), .resolution = 16});
  runs[0].cache_share = 0.25;
  runs[1].cache_share = 0;
  runs[2].cache_pages = 7;
  const std::vector<PaperSubject> subjects = paper_subjects(runs);
  const PaperResults results = carried_out(runs, subjects);
  const auto pages = static_cast<double>(subjects.front().subject.database.page_count());
  CHECK(results[0]->cache_pages == doctest::Approx(pages / 4).epsilon(0.5 / pages * 4));
  CHECK(results[1]->cache_pages == 1);
  CHECK(results[2]->cache_pages == 7);
}

TEST_CASE("no run is no result") {
  CHECK(paper_subjects({}).empty());
  CHECK(carried_out({}, {}).empty());
}

TEST_CASE("two runs of a scene that give different films are an error, and what was finished before is kept") {
  std::vector<PaperRun> runs = small_runs(), other = runs;
  runs[1].structure = core::Structure::extents;
  other[1].scene = "tetra-2";
  std::vector<PaperSubject> subjects = paper_subjects(other);
  REQUIRE(subjects.size() == 2);
  subjects[1].scene = "tetra-3";  // it is not
  subjects[1].structure = core::Structure::extents;
  Interrupt interrupt;
  PaperResults results(runs.size());
  CHECK_THROWS_AS(carry_out(runs, subjects, interrupt, results), core::InternalError);
  CHECK(results[0].has_value());
  CHECK_FALSE(results[1].has_value());
}

TEST_CASE("results without a place for each run are an error") {
  const std::vector<PaperRun> runs = small_runs();
  Interrupt interrupt;
  PaperResults too_few(2);
  CHECK_THROWS_AS(carry_out(runs, paper_subjects(runs), interrupt, too_few), core::InternalError);
}

}  // namespace dmpc::tests::paper_runs_test
