#include "apps/paper_memories.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <variant>

#include "tests/support/paper_results.h"

namespace dmpc::tests {

using namespace apps;

namespace {

double number(const Cell& cell) { return std::get<double>(cell); }

/// As if all three kinds of runs had come out as printed.
PaperResults all_as_printed(const Catalogue& catalogue) {
  PaperResults results = as_printed(catalogue);
  for (std::size_t row = 0; row < missing_rows.size(); ++row) {
    const PaperScene& paper = paper_scenes[missing_rows[row]];
    for (std::size_t column = paper.base(); column < paper_node_counts.size(); ++column) {
      results[catalogue.scattered[row][column]] = result_of_seconds(paper.seconds[column]);
      results[catalogue.whole_memory[row][column]] = result_of_seconds(paper.seconds[column]);
    }
  }
  return results;
}

}  // namespace

TEST_CASE("a node's cache holds what its own pages leave of 3.2 MB, and no more than all other pages") {
  const PaperScene &teapot = paper_scenes[0], &rings = paper_scenes[rings_row], &tetra = paper_scenes[tetra_row];
  CHECK(teapot.cache_share(1) == 0);
  CHECK(teapot.cache_share(4) == 0.75);                                 // it fits wholly
  CHECK(rings.cache_share(2) == doctest::Approx(3276.8 / 4632 - 0.5));  // 961 of 4632 KB
  CHECK(rings.cache_share(64) == doctest::Approx(3276.8 / 4632 - 1.0 / 64));
  CHECK(tetra.cache_share(8) == 0);  // an eighth is already too much
  CHECK(tetra.cache_share(16) == doctest::Approx(3276.8 / 36189 - 1.0 / 16));
}

TEST_CASE("every run of Table 3 on several nodes has the article's share of the database in its caches") {
  const Catalogue catalogue = catalogue_of(16);
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    for (std::size_t column = paper_scenes[scene].base(); column < paper_node_counts.size(); ++column) {
      const PaperRun& run = catalogue.runs[catalogue.timed[scene][column]];
      CHECK(run.cache_share.has_value() == (run.node_count > 1));
      CHECK(run.cache_share.value_or(0) == paper_scenes[scene].cache_share(run.node_count));
      CHECK_FALSE(run.node_memory_bytes.has_value());
    }
  }
}

TEST_CASE("a cache of a share of the database has so many pages, and at least one") {
  PaperRun run{.scene = "tetra-4", .node_count = 4, .machine = catalogue_of(16).runs.front().machine, .resolution = 16};
  std::vector<PaperRun> runs(2, run);
  runs[0].cache_share = 0.25;
  runs[1].cache_share = 0;
  const std::vector<PaperSubject> subjects = paper_subjects(runs);
  Interrupt interrupt;
  const PaperResults results = carry_out(runs, subjects, interrupt);
  const auto pages = static_cast<double>(subjects.front().subject.database.page_count());
  CHECK(results[0]->cache_pages == doctest::Approx(pages / 4).epsilon(0.5 / pages * 4));
  CHECK(results[1]->cache_pages == 1);
}

TEST_CASE("scattered records are a subject of their own that gives the same film") {
  PaperRun run{.scene = "tetra-4", .node_count = 2, .machine = catalogue_of(16).runs.front().machine, .resolution = 16};
  std::vector<PaperRun> runs(2, run);
  runs[1].record_order = core::RecordOrder::scattered;
  const std::vector<PaperSubject> subjects = paper_subjects(runs);
  CHECK(subjects.size() == 2);
  Interrupt interrupt;
  const PaperResults results = carry_out(runs, subjects, interrupt);
  CHECK(results[0]->film_hash == results[1]->film_hash);
  CHECK(results[0]->faults < results[1]->faults);
}

TEST_CASE("memories and orders of records are compared for all cells of Rings4 and Tetra9") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = all_as_printed(catalogue);
  CHECK(memories(catalogue, results).rows().size() == 7);
  results[catalogue.whole_memory[1][6]]->total_ns *= 2;
  const Table table = memories(catalogue, results);
  const auto& last = table.rows().back();
  CHECK(number(last[3]) == doctest::Approx(number(last[2])));
  CHECK(number(last[4]) == doctest::Approx(number(last[2])));
  CHECK(number(last[5]) == doctest::Approx(number(last[2]) / 2));
  results[catalogue.scattered[1][6]].reset();
  CHECK(memories(catalogue, results).rows().size() == 6);
  CHECK(memories(catalogue, results).notes().back() == "Interrupted: 1 of 7 rows are missing.");
}

}  // namespace dmpc::tests
