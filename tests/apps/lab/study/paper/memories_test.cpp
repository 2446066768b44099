#include "apps/lab/study/paper/tables.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/paper_results.h"
#include "tests/support/table_cells.h"

namespace dmpc::tests::memories_test {

using namespace apps;

namespace {

/// As if all kinds of runs had come out as printed.
PaperResults all_as_printed(const Catalogue& catalogue) {
  PaperResults results = as_printed(catalogue);
  for (std::size_t row = 0; row < missing_rows.size(); ++row) {
    const PaperScene& paper = paper_scenes[missing_rows[row]];
    for (std::size_t column = paper.base(); column < paper_node_counts.size(); ++column) {
      results[catalogue.scattered[row][column]] = result_of_seconds(paper.seconds[column]);
      results[catalogue.figures_memory[row][column]] = result_of_seconds(paper.seconds[column]);
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
  const PaperResults results = carried_out(runs, subjects);
  const auto pages = static_cast<double>(subjects.front().subject.database.page_count());
  CHECK(results[0]->cache_pages == doctest::Approx(pages / 4).epsilon(0.5 / pages * 4));
  CHECK(results[1]->cache_pages == 1);
}

TEST_CASE("scattered records are a subject of their own that gives the same film") {
  PaperRun run{.scene = "tetra-6", .node_count = 2, .machine = catalogue_of(16).runs.front().machine, .resolution = 16};
  std::vector<PaperRun> runs(2, run);
  runs[1].record_order = core::RecordOrder::scattered;
  const std::vector<PaperSubject> subjects = paper_subjects(runs);
  CHECK(subjects.size() == 2);
  const PaperResults results = carried_out(runs, subjects);
  CHECK(results[0]->film_hash == results[1]->film_hash);
  CHECK(results[0]->faults < results[1]->faults);
}

TEST_CASE("the figures' caches leave a node's own pages beside the largest cache on 32 nodes, and no other memory") {
  CHECK(cache_scenes[0].shared_kilobytes() == 3242 + 4632 / 32.0);
  CHECK(cache_scenes[1].shared_kilobytes() == 2895 + 36189 / 32.0);
  const Catalogue catalogue = catalogue_of(16);
  for (std::size_t row = 0; row < missing_rows.size(); ++row) {
    const PaperRun& run = catalogue.runs[catalogue.figures_memory[row][5]];
    CHECK(run.scene == paper_scenes[missing_rows[row]].scene);
    CHECK(run.node_count == 32);
    CHECK(run.cache_share == doctest::Approx(cache_scenes[row].share(cache_size_count - 1)));
    CHECK_FALSE(run.node_memory_bytes.has_value());
    CHECK(run.record_order == core::RecordOrder::spatial);
  }
  const PaperRun& on_64 = catalogue.runs[catalogue.figures_memory[1][6]];
  CHECK(*on_64.cache_share == doctest::Approx((2895 + 36189 / 32.0 - 36189 / 64.0) / 36189));
}

TEST_CASE("memories and orders of records are compared for all cells of Rings4 and Tetra9") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = all_as_printed(catalogue);
  CHECK(memories(catalogue, results).rows().size() == 7);
  results[catalogue.figures_memory[1][6]]->total_ns *= 2;
  results[catalogue.whole_memory[1][6]]->total_ns *= 4;
  const Table table = memories(catalogue, results);
  const auto& last = table.rows().back();
  CHECK(number(last[3]) == doctest::Approx(number(last[2])));
  CHECK(number(last[4]) == doctest::Approx(number(last[2])));
  CHECK(number(last[5]) == doctest::Approx(number(last[2]) / 2));
  CHECK(number(last[6]) == doctest::Approx(number(last[2]) / 4));
}

TEST_CASE("the differences of every kind of memory stand in a note, and so does where the article contradicts itself") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = all_as_printed(catalogue);
  results[catalogue.figures_memory[1][6]]->total_ns *= 2;  // 94.55 % before
  const std::vector<std::string> notes = memories(catalogue, results).notes();
  const auto has = [&](const std::string& words) {
    return std::any_of(notes.begin(), notes.end(), [&](const auto& note) { return note.find(words) != std::string::npos; });
  };
  CHECK(
      has("in points: the article's share 0.00 and 0.00; records scattered 0.00 and 0.00; the figures' caches 6.75 and 47.28; "
          "the article's 4 MB 0.00 and 0.00."));
  CHECK(has("3387 KB together"));
  CHECK(has("4026 KB together. The article contradicts itself here: its text says about 3277 KB."));
  CHECK(has("Tetra10 fits into none"));
}

TEST_CASE("a cell of which one kind of memory is missing is left out of all") {
  const Catalogue catalogue = catalogue_of(16);
  for (const auto* kind : {&catalogue.scattered, &catalogue.figures_memory, &catalogue.whole_memory}) {
    PaperResults results = all_as_printed(catalogue);
    results[(*kind)[1][6]].reset();
    CHECK(memories(catalogue, results).rows().size() == 6);
    CHECK(memories(catalogue, results).notes().back() == "Unfinished: 1 of 7 rows are missing.");
  }
}

}  // namespace dmpc::tests::memories_test
