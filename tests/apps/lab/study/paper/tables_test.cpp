#include "apps/lab/study/paper/tables.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "core/trace/charge.h"
#include "tests/support/paper_results.h"
#include "tests/support/table_cells.h"

namespace dmpc::tests::tables_test {

using namespace apps;

namespace {

std::uint64_t whole(std::uint64_t value) { return value; }

}  // namespace

TEST_CASE("Table 3 has 24 cells, and results as printed differ by nothing, on either structure") {
  const Catalogue catalogue = catalogue_of(16);
  const PaperResults results = as_printed(catalogue);
  CHECK(printed_cell_count() == 24);
  for (const Table& table : {table_3(catalogue, results), grid_table_3(catalogue, results)}) {
    REQUIRE(table.rows().size() == 24);
    for (std::size_t row = 0; row < table.rows().size(); ++row) {
      CHECK(real(table, row, "found over printed") == 1);
      CHECK(real(table, row, "the same a ray") == doctest::Approx(1));
      CHECK(real(table, row, "difference") == 0);
    }
  }
  CHECK(has_note(table_3(catalogue, results), "0.00 points on average and 0.00 at worst, 17 cells"));
  CHECK(has_note(grid_table_3(catalogue, results), "0.00 points on average and 0.00 at worst, 18 cells"));
}

TEST_CASE("Table 3 has what one worker takes, on one node or beside nodes that lend their memories") {
  const Catalogue catalogue = catalogue_of(16);
  for (const TimedRuns& runs : {catalogue.article, catalogue.grid}) {
    CHECK(runs.one_worker[0] == runs.timed[0][0]);
    const PaperRun& lone = catalogue.runs[runs.one_worker[3]];
    CHECK(lone.node_count == 16);
    CHECK(lone.pages.worker_count == 1U);
    CHECK(lone.cache_share == catalogue.runs[runs.timed[3][4]].cache_share);
  }
  PaperResults results = as_printed(catalogue);
  results[catalogue.article.one_worker[3]] = result_of_seconds(64 * 78);
  const Table table = table_3(catalogue, results);
  CHECK(real(table, 1, "one worker") == 11'522);
  CHECK(real(table, 22, "efficiency against it") == doctest::Approx(100));
  CHECK(is_missing(table, 23, "one worker"));
}

TEST_CASE("every run of 1994 has one pixel in flight, rays without backpressure, and the machine with prices for voxels") {
  const Catalogue catalogue = catalogue_of(16);
  for (const std::size_t number : {catalogue.article.timed[2][6], catalogue.rings_by_rays[0][6], catalogue.cached[0][0],
                                   catalogue.lit_by_rays, catalogue.equal_sizes[1], catalogue.copies}) {
    const PaperRun& run = catalogue.runs[number];
    CHECK(run.machine.name == "ipsc2-1994");
    CHECK(run.structure == core::Structure::voxels);
    CHECK(run.pages.in_flight == 1U);
    CHECK(run.rays.without_backpressure == (run.strategy == Strategy::dataflow));
    CHECK((run.strategy != Strategy::dataflow || run.rays.balance.bsp.order == dataflow::CutOrder::alternating));
  }
}

TEST_CASE("a cell that is two points off is found") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = as_printed(catalogue);
  PaperResult& teapot_on_64 = *results[catalogue.article.timed[0][6]];
  const double printed = cells_of(catalogue.article, results)[6].printed_efficiency;
  teapot_on_64.total_ns = static_cast<std::uint64_t>(static_cast<double>(teapot_on_64.total_ns) * printed / (printed - 2));
  CHECK(cells_of(catalogue.article, results)[6].efficiency == doctest::Approx(printed - 2));
  const Table table = table_3(catalogue, results);
  CHECK(real(table, 6, "difference") == doctest::Approx(-2));
  CHECK(has_note(table, "Predicted efficiencies differ by 0.12 points on average and 2.00 at worst, 17 cells."));
}

TEST_CASE("Table 2 has what its run counted and its database holds beside what is printed") {
  const Catalogue catalogue = catalogue_of(8);
  const std::size_t run = catalogue.counted[0];
  PaperResults results(catalogue.runs.size());
  results[run] = PaperResult{.rays = 1234, .pages_a_pixel = 5.5};
  const std::vector<PaperSubject> subjects = paper_subjects(std::span(catalogue.runs).subspan(run, 1));
  const core::Database& database = subjects.front().subject.database;
  const Table table = table_2(catalogue, results, subjects);
  REQUIRE(table.rows().size() == 1);
  CHECK(table.rows()[0] == std::vector<Cell>{"Teapot", "teapot-8", whole(3754), whole(database.header().primitive_count),
                                             whole(1'397'473), whole(1234), whole(793), whole(860), 860 / 793.0, 58.19, 5.5,
                                             5.5 / 58.19});
  CHECK(table.notes().front() == "Rays and scenes: Teapot, another teapot: theirs is not published.");
  CHECK(has_note(table, "4 of 5 rows are missing"));
}

TEST_CASE("both algorithms are held against one node on which nothing travels, and the notes say on which computers") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = all_alike(catalogue);
  results[catalogue.rings_by_pages[0][0]] = result_of_seconds(one_node_seconds);
  results[catalogue.rings_by_pages[0][6]] = result_of_efficiency(80, 64);
  results[catalogue.rings_by_rays[0][6]] = result_of_efficiency(40, 64);
  const Table table = algorithms(catalogue, results);
  REQUIRE(table.rows().size() == 14);
  const std::vector<Cell>& on_64 = table.rows()[6];
  CHECK(on_64[0] == Cell("rings-3-t1"));
  CHECK(on_64[1] == Cell(whole(64)));
  CHECK(number(on_64[4]) == doctest::Approx(40));
  CHECK(number(on_64[5]) == doctest::Approx(80));
  CHECK(has_note(table, "did not fit into the memories of 2 and 4 nodes"));
}

TEST_CASE("the notes on the computers of both algorithms are true of their runs") {
  const Catalogue catalogue = catalogue_of(16);
  for (std::size_t column = 1; column < paper_node_counts.size(); ++column) {
    CHECK(catalogue.rings_by_pages[1][column] == catalogue.article.timed[rings_row][column]);
    for (const std::size_t run :
         {catalogue.rings_by_pages[0][column], catalogue.rings_by_rays[0][column], catalogue.rings_by_rays[1][column]}) {
      CHECK(catalogue.runs[run].node_memory_bytes == std::size_t{4} << 20U);
    }
  }
}

TEST_CASE("caches have the article's pages, with their efficiency, faults and traffic both ways") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results(catalogue.runs.size());
  CacheFigures figures;
  figures.efficiency.fill(50);
  figures.traffic.fill(0.3);
  set_caches(results, catalogue, 1, figures);
  PaperResult& largest = *results[catalogue.cached[1].back()];
  largest.references = 1'000;
  largest.faults = 77;
  largest.parts.ns = {60, 30, 0, 0, 0, 0, 0, 10, 0, 0, 0};
  CHECK(catalogue.runs[catalogue.cached[1].back()].cache_pages == 2895U);
  CHECK(catalogue.runs[catalogue.cached[1].back()].node_count == 32);
  const Table table = caches(catalogue, results);
  REQUIRE(table.rows().size() == 10);
  CHECK(text(table, 9, "scene") == "Tetra9");
  CHECK(tests::whole(table, 9, "cache") == 2895);
  CHECK(tests::whole(table, 9, "faults") == 77);
  CHECK(real(table, 9, "of the database") == doctest::Approx(100 * 2895 / 36189.0));
  CHECK(real(table, 9, "efficiency") == doctest::Approx(50));
  CHECK(real(table, 9, "miss ratio") == doctest::Approx(7.7));
  CHECK(real(table, 9, "pages received") == doctest::Approx(0.15 * 0.9e6));
  CHECK(real(table, 9, "traffic both ways") == doctest::Approx(30));
  CHECK(real(table, 9, "page wait") == doctest::Approx(30));
  CHECK(has_note(table, "10 of 20 rows are missing"));
}

TEST_CASE(
    "the 70 % that are printed at 204 pages stand beside that size of Rings4 alone, and both bases of efficiencies are said") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = as_printed(catalogue);
  set_caches(results, catalogue, 0, {{50, 50, 50, 50, 50, 50, 50, 50, 50, 50}, {}});
  results[catalogue.rings_by_pages[1][0]] = result_of_seconds(32 * 1181 * 8 / 10);
  const Table table = caches(catalogue, results);
  REQUIRE(table.rows().size() == 10);
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    CHECK(is_missing(table, row, "printed") == (tests::whole(table, row, "cache") != 204));
  }
  CHECK(has_note(table, "with all of the 4 MB has 94.9 % there, and 80.0 % here"));
}

TEST_CASE("regions are those of Rings3 on 16, 32 and 64 nodes, with their load and their tests beside one node's") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results(catalogue.runs.size());
  results[catalogue.rings_by_rays[0][0]].emplace(result_of_seconds(100)).tests = 1000;
  PaperResult& many = results[catalogue.rings_by_rays[0][6]].emplace(result_of_seconds(10));
  many.average_load = 0.825;
  many.tests = 1040;
  CHECK(catalogue.runs[catalogue.equal_sizes[0]].node_count == 16);
  CHECK(catalogue.runs[catalogue.equal_sizes[0]].rays.balance.balance == dataflow::Balance::equal_size);
  const Table table = region_loads(catalogue, results);
  REQUIRE(table.rows().size() == 1);
  CHECK(text(table, 0, "regions") == "subsampled");
  CHECK(tests::whole(table, 0, "nodes") == 64);
  CHECK(real(table, 0, "average load") == doctest::Approx(82.5));
  CHECK(real(table, 0, "tests over one node's") == doctest::Approx(1.04));
  CHECK(has_note(table, "5 of 6 rows are missing"));
}

TEST_CASE("counting the pages of pixels takes no time of the machine's: such a run is that of one node") {
  const Catalogue catalogue = catalogue_of(16);
  const std::vector<PaperRun> runs = {catalogue.runs[catalogue.article.timed[1][0]], catalogue.runs[catalogue.counted[1]]};
  const PaperResults results = carried_out(runs, paper_subjects(runs));
  REQUIRE((results[0] && results[1]));
  CHECK(results[0]->total_ns == results[1]->total_ns);
  CHECK(results[1]->pages_a_pixel > 0);
}

TEST_CASE("ways for rays to travel have their efficiency against one node, and what went by way of the host") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results(catalogue.runs.size());
  results[catalogue.rings_by_pages[1][0]] = result_of_seconds(6400);
  PaperResult unchecked = result_of_seconds(200);
  unchecked.average_load = 0.7;
  unchecked.overflowed = 0.03;
  unchecked.ray_bytes = 5;
  unchecked.tests = 9;
  results[catalogue.by_way(1, RayWay::long_queue)] = unchecked;
  const Table table = ray_ways(catalogue, results);
  REQUIRE(table.rows().size() == 1);
  CHECK(table.rows()[0] ==
        std::vector<Cell>{"rings-4-t1", "long queue", 200.0, 50.0, 70.0, 3.0, std::uint64_t{5}, std::uint64_t{9}});
}

TEST_CASE("work items have their seconds and where they go, static first") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results(catalogue.runs.size());
  results[catalogue.items[0]] = result_of_seconds(700);
  results[catalogue.items[0]]->parts.ns = {60, 0, 10, 0, 0, 0, 0, 0, 0, 5, 25};
  results[catalogue.items[3]] = result_of_seconds(604);
  results[catalogue.assigned_items] = result_of_seconds(650);
  const Table table = work_items(catalogue, results);
  REQUIRE(table.rows().size() == 3);
  CHECK(table.rows()[0] == std::vector<Cell>{"static", "nobody", 700.0, 60.0, 0.0, 10.0, 5.0, 25.0, whole(0)});
  CHECK(table.rows()[1][0] == Cell("3x3"));
  CHECK(table.rows()[2][1] == Cell("host"));
  CHECK(table.notes().back() == "Unfinished: 6 of 9 rows are missing.");
}

TEST_CASE("a table says how many rows are missing, if any, and cannot have more than all") {
  Table table("", {{"a"}});
  table.add_row({std::uint64_t{1}});
  note_missing_rows(table, 1);
  CHECK(table.notes().empty());
  note_missing_rows(table, 2);
  CHECK(table.notes().back() == "Unfinished: 1 of 2 rows are missing.");
  CHECK_THROWS_AS(note_missing_rows(table, 0), core::InternalError);
}

TEST_CASE("differences have a mean and a worst, whatever their sign, and none has neither") {
  Differences differences;
  CHECK(differences.mean() == 0);
  differences.add(-3);
  differences.add(1);
  CHECK(differences.mean() == 2);
  CHECK(differences.worst == 3);
}

TEST_CASE("rows whose runs are missing are left out, and so is what rests on them") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = as_printed(catalogue);
  results[catalogue.article.timed[3][4]].reset();  // Tetra9's base
  const std::vector<TimedCell> cells = cells_of(catalogue.article, results);
  REQUIRE(cells.size() == 23);
  CHECK_FALSE(cells[21].efficiency.has_value());
  CHECK_FALSE(cells[21].is_predicted());
  CHECK(table_3(catalogue, results).rows().size() == 23);
  CHECK(has_note(table_3(catalogue, results), "1 of 24 rows are missing"));
  CHECK(has_note(losses(catalogue, results), "1 of 24 rows are missing"));
  CHECK(algorithms(catalogue, results).rows().empty());
  CHECK(claims(catalogue, PaperResults(catalogue.runs.size())).rows().empty());
}

}  // namespace dmpc::tests::tables_test
