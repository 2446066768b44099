#include "apps/lab/study/paper/tables.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/paper_results.h"
#include "tests/support/table_cells.h"
#include "tests/support/text.h"

namespace dmpc::tests::price_tables_test {

using namespace apps;

namespace {

/// A run of as many rays as are printed, all of whose time is computing, of steps and of look-ups of other nodes' pages.
PaperResult computed(const PaperScene& scene, std::uint32_t node_count, double seconds) {
  const nodes::Machine machine = voxel_machine(fitted_voxel_prices);
  PaperResult result{.total_ns = static_cast<std::uint64_t>(1e9 * seconds), .rays = scene.rays};
  result.parts.ns[0] = node_count * result.total_ns;
  const auto charge = static_cast<std::size_t>(core::Charge::cell_step);
  result.charges[charge] = 1000 * result.parts.ns[0] / machine.cost_ps[charge];
  return result;
}

/// Every cell on voxels as printed, times `factor`.
PaperResults results_of(const Catalogue& catalogue, double factor) {
  PaperResults results(catalogue.runs.size());
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    for (std::size_t column = paper_scenes[scene].base(); column < paper_node_counts.size(); ++column) {
      results[catalogue.article.timed[scene][column]] =
          computed(paper_scenes[scene], paper_node_counts[column], factor * paper_scenes[scene].seconds[column]);
    }
  }
  return results;
}

/// The time of a ray in this cell over that which is printed.
double ratio_at(const PaperPlace& place, std::uint32_t resolution) {
  const Catalogue catalogue = catalogue_of(resolution);
  const std::size_t number = catalogue.article.timed[place.scene][place.column];
  const std::vector<PaperRun> runs = {catalogue.runs[number]};
  PaperResults results(catalogue.runs.size());
  results[number] = carried_out(runs, paper_subjects(runs)).front();
  return cells_of(catalogue.article, results).at(0).ratio();
}

}  // namespace

TEST_CASE("four cells are fitted: the smallest and the largest machine of Mountain and of Rings4") {
  const Catalogue catalogue = catalogue_of(16);
  std::vector<std::string> fitted;
  for (const TimedCell& cell : cells_of(catalogue.article, results_of(catalogue, 1))) {
    if (cell.is_fitted) {
      fitted.push_back(std::string(cell.scene().title) + " " + std::to_string(cell.nodes()));
    }
  }
  CHECK(fitted == std::vector<std::string>{"Mountain 1", "Mountain 64", "Rings4 2", "Rings4 64"});
}

TEST_CASE("Table 3 has 24 cells, of which 20 are predicted or bases, and says how far off they are") {
  const Catalogue catalogue = catalogue_of(16);
  const Table same = table_3(catalogue, results_of(catalogue, 1));
  REQUIRE(same.rows().size() == 24);
  for (std::size_t row = 0; row < same.rows().size(); ++row) {
    CHECK(real(same, row, "found over printed") == doctest::Approx(1));
    CHECK(real(same, row, "difference") == doctest::Approx(0).epsilon(1e-6));
  }
  CHECK(has_note(same, "lie off by 0.0 % in the mean and 0.0 % at worst, 20 cells"));
  CHECK(has_note(same, "0.00 points on average and 0.00 at worst, 17 cells"));
  CHECK(has_note(table_3(catalogue, results_of(catalogue, 1.25)), "25.0 % in the mean and 25.0 % at worst, 20 cells"));
}

TEST_CASE("a run of half the rays in half the time takes as long a ray") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = results_of(catalogue, 0.5);
  PaperResult& teapot = *results[catalogue.article.timed[0][0]];
  teapot.rays /= 2;
  const Table table = table_3(catalogue, results);
  CHECK(real(table, 0, "found over printed") == doctest::Approx(0.5));
  CHECK(real(table, 0, "the same a ray") == doctest::Approx(1).epsilon(1e-4));
}

TEST_CASE("the fitted prices rest on their four cells and on no other") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = results_of(catalogue, 1);
  const Table before = voxel_prices(catalogue, results);
  REQUIRE(before.rows().size() == 5);
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    for (std::size_t column = paper_scenes[scene].base(); column < paper_node_counts.size(); ++column) {
      const PaperPlace place{scene, column};
      if (std::find(fitted_places.begin(), fitted_places.end(), place) == fitted_places.end()) {
        results[catalogue.article.timed[scene][column]] = computed(paper_scenes[scene], paper_node_counts[column], 7);
      }
    }
  }
  CHECK(voxel_prices(catalogue, results).rows() == before.rows());
}

TEST_CASE("times that steps alone explain have the step's price fitted, and twice the time twice the price") {
  const Catalogue catalogue = catalogue_of(16);
  const double once = real(voxel_prices(catalogue, results_of(catalogue, 1)), 0, "fitted");
  CHECK(once == doctest::Approx(1e-6 * 7'500 * fitted_voxel_prices.walk).epsilon(0.001));
  // The same counts, said to have taken twice as long as is printed, are fitted by half the price.
  PaperResults slower = results_of(catalogue, 2);
  CHECK(real(voxel_prices(catalogue, slower), 0, "fitted") == doctest::Approx(once / 2).epsilon(0.001));
}

TEST_CASE("there are ten pairs of scenes, and each says what its prices make of all five") {
  const Catalogue catalogue = catalogue_of(16);
  const Table table = voxel_pairs(catalogue, results_of(catalogue, 1));
  REQUIRE(table.rows().size() == 10);
  CHECK(text(table, 0, "fitted to") == "Teapot, Mountain");
  CHECK(text(table, 9, "fitted to") == "Tetra9, Tetra10");
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    CHECK(real(table, row, "Rings4") == doctest::Approx(1).epsilon(0.001));
    CHECK(real(table, row, "worst error") < 0.1);
  }
}

TEST_CASE("without results the tables on voxels are empty and say what is missing") {
  const Catalogue catalogue = catalogue_of(16);
  const PaperResults none(catalogue.runs.size());
  CHECK(has_note(table_2(catalogue, none, {}), "5 of 5 rows are missing"));
  CHECK(has_note(table_3(catalogue, none), "24 of 24 rows are missing"));
  CHECK(has_note(voxel_prices(catalogue, none), "5 of 5 rows are missing"));
  CHECK(has_note(voxel_pairs(catalogue, none), "10 of 10 rows are missing"));
}

TEST_CASE("runs on voxels have the article's bytes: 3276 pages of 1 KB in memories of 4 MiB, on one node all") {
  const Catalogue catalogue = catalogue_of(16);
  CHECK(shared_pages == 3276);
  const PaperRun& one = catalogue.runs[catalogue.article.timed[1][0]];
  CHECK_FALSE(one.shared_pages.has_value());
  CHECK_FALSE(one.node_memory_bytes.has_value());
  const PaperRun& many = catalogue.runs[catalogue.article.timed[4][6]];
  CHECK(many.shared_pages == shared_pages);
  CHECK(many.node_memory_bytes == std::size_t{4} << 20U);
  CHECK(catalogue.runs[catalogue.article.one_worker[3]].pages.worker_count == 1U);
}

TEST_CASE("what opens the report says how many cells are fitted, how far off the others are, and both reservations") {
  const Catalogue catalogue = catalogue_of(paper_resolution);
  PaperResults results = results_of(catalogue, 1);
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    const std::size_t base = paper_scenes[scene].base();
    results[catalogue.grid.timed[scene][base]] = result_of_seconds(paper_scenes[scene].seconds[base] / 2);
  }
  results[catalogue.article.timed[0][6]]->total_ns *= 2;
  results[catalogue.faster_machine] = results[catalogue.article.timed[rings_row][cache_column]];
  const std::vector<std::string> texts = summary_texts(catalogue, results);
  REQUIRE(texts.size() == 6);
  CHECK(contains(texts[0], "24 printed cells. Three prices are fitted to 4 of them"));
  CHECK(contains(texts[0],
                 "5.0 % in the mean and 100.0 % at worst, 20 cells; without Teapot, another scene than theirs, by 0.0 %"));
  CHECK(
      contains(texts[1], "First reservation: the structure and the two scenes were chosen by someone who had seen all 24 cells"));
  CHECK(contains(texts[2], "the seconds of other scenes than Mountain are 0.50 to 0.50 of the printed ones"));
  CHECK(texts[3] == "Claims of the text: 2 not held.");
  CHECK(texts[4].starts_with("Not held: With up to 64 nodes the efficiency"));
  CHECK(texts[5].starts_with("Not held: The iPSC/860 is about 7 times faster (Rings4, 32 nodes). Found: 1.00 times"));
  const Table table = summary_table(catalogue, results);
  REQUIRE(table.rows().size() == 5);
  CHECK(text(table, 0, "64 nodes") == "200 / 400");
  CHECK(text(table, 1, "64 nodes") == "307 / 307 *");
  CHECK(is_missing(table, 2, "1 node"));
}

TEST_CASE("nothing is summed up that pictures of another size cannot tell, nor where there is nothing") {
  const Catalogue small = catalogue_of(16);
  const std::vector<std::string> texts = summary_texts(small, results_of(small, 1));
  REQUIRE(texts.size() == 1);
  CHECK(texts[0] == "Claims of the text: 1 not judged.");
  CHECK(summary_texts(small, PaperResults(small.runs.size())).empty());
  CHECK(summary_table(small, PaperResults(small.runs.size())).rows().empty());
}

TEST_CASE("the machine of voxels is fitted: Mountain takes on 1 and 64 nodes what it takes a ray" * doctest::test_suite("slow")) {
  CHECK(ratio_at({1, 0}, paper_resolution) == doctest::Approx(1).epsilon(0.005));
  CHECK(ratio_at({1, 6}, paper_resolution) == doctest::Approx(1).epsilon(0.005));
}

TEST_CASE("a sixteenth of the rays of Rings4 takes on two nodes what they take" * doctest::test_suite("slow")) {
  CHECK(ratio_at({2, 1}, paper_resolution / 4) == doctest::Approx(1).epsilon(0.06));
}

}  // namespace dmpc::tests::price_tables_test
