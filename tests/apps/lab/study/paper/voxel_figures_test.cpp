#include <doctest/doctest.h>

#include <vector>

#include "apps/lab/study/paper/tables.h"
#include "tests/support/paper_results.h"
#include "tests/support/table_cells.h"

namespace dmpc::tests::voxel_figures_test {

using namespace apps;

TEST_CASE("caches on voxels have the article's pages, and are held against one node on which nothing travels") {
  const Catalogue catalogue = catalogue_of(16);
  const PaperRun& smallest = catalogue.runs[catalogue.voxels.cached[0].front()];
  CHECK(smallest.cache_pages == 102U);
  CHECK(smallest.node_count == 32);
  CHECK(smallest.resolution == 16);
  CHECK(catalogue.runs[catalogue.voxels.counted[2]].node_count == 1);
  PaperResults results(catalogue.runs.size());
  results[catalogue.voxels.counted[2]] = result_of_seconds(one_node_seconds);
  PaperResult& found = results[catalogue.voxels.cached[0][1]].emplace(result_of_efficiency(64, 32));
  found.references = 1000;
  found.faults = 50;
  const Table table = voxel_caches(catalogue, results);
  REQUIRE(table.rows().size() == 1);
  CHECK(whole(table, 0, "cache") == 204);
  CHECK(real(table, 0, "efficiency") == doctest::Approx(64));
  CHECK(real(table, 0, "miss ratio") == doctest::Approx(5));
  CHECK(has_note(table, "11 of 12 rows are missing"));
}

TEST_CASE("counting the pages of pixels takes no time of the machine's: such a run is that of one node") {
  const Catalogue catalogue = catalogue_of(16);
  const std::vector<PaperRun> runs = {catalogue.runs[catalogue.voxels.timed[1][0]], catalogue.runs[catalogue.voxels.counted[1]]};
  const PaperResults results = carried_out(runs, paper_subjects(runs));
  REQUIRE((results[0] && results[1]));
  CHECK(results[0]->total_ns == results[1]->total_ns);
  CHECK(results[1]->pages_a_pixel > 0);
}

TEST_CASE("a cache of so many pages holds so many") {
  const std::vector<PaperRun> runs = {
      {.scene = "rings-2-t1", .node_count = 4, .machine = paper_machine(), .cache_pages = 7, .resolution = 8}};
  CHECK(carried_out(runs, paper_subjects(runs)).front()->cache_pages == 7);
}

TEST_CASE("regions on voxels are those of Rings3 on 16, 32 and 64 nodes, with their load and their tests beside one node's") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results(catalogue.runs.size());
  PaperResult& one = results[catalogue.voxels.one_region].emplace(result_of_seconds(100));
  one.tests = 1000;
  PaperResult& many = results[catalogue.voxels.subsampled[2]].emplace(result_of_seconds(10));
  many.average_load = 0.825;
  many.tests = 1040;
  CHECK(catalogue.runs[catalogue.voxels.subsampled[2]].node_count == 64);
  CHECK(catalogue.runs[catalogue.voxels.equal_size[0]].rays.balance.balance == dataflow::Balance::equal_size);
  const Table table = voxel_loads(catalogue, results);
  REQUIRE(table.rows().size() == 1);
  CHECK(text(table, 0, "regions") == "subsampled");
  CHECK(whole(table, 0, "nodes") == 64);
  CHECK(real(table, 0, "average load") == doctest::Approx(82.5));
  CHECK(real(table, 0, "tests over one node's") == doctest::Approx(1.04));
  CHECK(has_note(table, "5 of 6 rows are missing"));
}

namespace {

/// Results at the article's resolution: everything as it claims, but for a peak that no size tried has behind it.
PaperResults results_as_claimed(const Catalogue& catalogue) {
  PaperResults results(catalogue.runs.size());
  for (std::size_t i = 0; i < voxel_caches_tried.size(); ++i) {
    results[catalogue.voxels.counted[voxel_caches_tried[i].scene]] = result_of_seconds(one_node_seconds);
    for (std::size_t size = 0; size < voxel_caches_tried[i].pages.size(); ++size) {
      PaperResult& result =
          results[catalogue.voxels.cached[i][size]].emplace(result_of_efficiency(i == 0 && size < 1 ? 40 : 80, 32));
      const double rate = size == 1 ? 0.7 * 0.9e6 : 1e5;
      result.page_bytes = static_cast<std::uint64_t>(rate * 32 * result.seconds());
    }
  }
  for (std::size_t i = 0; i < loaded_node_counts.size(); ++i) {
    results[catalogue.voxels.subsampled[i]].emplace().average_load = 0.825;
    results[catalogue.voxels.equal_size[i]].emplace().average_load = 0.19;
  }
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    PaperResult& counted = results[catalogue.voxels.counted[scene]].emplace(result_of_seconds(one_node_seconds));
    counted.database_bytes = 1000;
    results[catalogue.voxels.extents[scene]] =
        PaperResult{.total_ns = 2 * counted.total_ns, .database_bytes = counted.database_bytes / 2};
  }
  return results;
}

}  // namespace

TEST_CASE("claims on voxels are held by results as the article has them, each by its own") {
  const Catalogue catalogue = catalogue_of(512);
  PaperResults results = results_as_claimed(catalogue);
  const Table all = voxel_claims(catalogue, results);
  REQUIRE(all.rows().size() == 5);
  for (std::size_t row = 0; row < all.rows().size(); ++row) {
    CHECK(text(all, row, "verdict") == "held");
  }
  for (const std::size_t run : catalogue.voxels.subsampled) {
    results[run]->average_load = 0.9;
  }
  results[catalogue.voxels.cached[0][0]]->page_bytes *= 20;
  const Table other = voxel_claims(catalogue, results);
  CHECK(text(other, 0, "verdict") == "not held");
  CHECK(text(other, 0, "found").starts_with("90.0, 90.0, 90.0 % and 19.0, 19.0, 19.0 % on 16, 32 and 64 nodes"));
  CHECK(text(other, 1, "found") ==
        "the smallest of those tried: Rings4 204 pages, 4.40 % of the database; Tetra9 51 pages, 0.14 % of the database");
  CHECK(text(other, 2, "verdict") == "not held");
  CHECK(text(other, 2, "found") == "of the caches tried, from 102 pages on, the most travels with 102");
  CHECK(text(other, 3, "verdict") == "held");
  CHECK(text(other, 4, "found") ==
        "memory 0.50 to 0.50, time 2.00 to 2.00 of those in space, on one node; eight boxes cost what one record does");
  CHECK(voxel_claims(catalogue, PaperResults(catalogue.runs.size())).rows().empty());
}

}  // namespace dmpc::tests::voxel_figures_test
