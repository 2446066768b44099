#include "apps/paper_runs.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "apps/machines.h"
#include "apps/paper_data.h"
#include "core/scenes.h"

namespace dmpc::apps {

namespace {

std::vector<PaperRun> small_runs() {
  const PaperRun like{.scene = "tetra-3", .machine = find_machine_preset("ipsc2")->machine, .resolution = 16};
  std::vector<PaperRun> runs(3, like);
  runs[1].node_count = 4;
  runs[2].node_count = 4;
  runs[2].rays_travel = true;
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
  Interrupt interrupt;
  const auto results = carry_out(runs, subjects, interrupt);
  REQUIRE(results.size() == 3);
  REQUIRE((results[0] && results[1] && results[2]));
  CHECK(results[1]->total_ns < results[0]->total_ns);
  CHECK(results[2]->film_hash == results[0]->film_hash);
  CHECK(results[0]->faults == 0);
  CHECK(results[1]->faults > 0);
  CHECK(results[1]->parts.total_ns() == 4 * results[1]->total_ns);
}

TEST_CASE("the runs of a study take the same virtual time every time") {
  const std::vector<PaperRun> runs = small_runs();
  const std::vector<PaperSubject> subjects = paper_subjects(runs);
  Interrupt interrupt;
  const auto first = carry_out(runs, subjects, interrupt), second = carry_out(runs, subjects, interrupt);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    CHECK(first[i]->total_ns == second[i]->total_ns);
  }
}

TEST_CASE("no run is no result") {
  Interrupt interrupt;
  CHECK(paper_subjects({}).empty());
  CHECK(carry_out({}, {}, interrupt).empty());
}

}  // namespace dmpc::apps
