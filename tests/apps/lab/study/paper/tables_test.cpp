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

TEST_CASE("Table 3 has 24 cells, and results as printed differ by nothing") {
  const Catalogue catalogue = catalogue_of(16);
  const PaperResults results = as_printed(catalogue);
  CHECK(cells_of_table_3(catalogue, results).size() == 24);
  CHECK(printed_cell_count() == 24);
  const Table table = table_3(catalogue, results);
  CHECK(table.rows().size() == 24);
  for (const auto& row : table.rows()) {
    CHECK(number(row[4]) == 1);
    CHECK(number(row[7]) == 0);
  }
  CHECK(table.notes().back().find("0.00 points on average and 0.00 at worst, 18 cells") != std::string::npos);
}

TEST_CASE("Table 3 has what one worker takes, on one node or beside nodes that lend their memories") {
  const Catalogue catalogue = catalogue_of(16);
  CHECK(catalogue.one_worker[0] == catalogue.timed[0][0]);
  const PaperRun& lone = catalogue.runs[catalogue.one_worker[3]];
  CHECK(lone.node_count == 16);
  CHECK(lone.pages.worker_count == 1U);
  CHECK(lone.cache_share == catalogue.runs[catalogue.timed[3][4]].cache_share);
  PaperResults results = as_printed(catalogue);
  results[catalogue.one_worker[3]] = result_of_seconds(64 * 78);
  const Table table = table_3(catalogue, results);
  CHECK(number(table.rows()[1][9]) == 11'522);
  CHECK(number(table.rows()[22][10]) == doctest::Approx(100));
  CHECK(table.rows()[23][9] == Cell());
}

TEST_CASE("a cell that is two points off is found") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = as_printed(catalogue);
  PaperResult& teapot_on_64 = *results[catalogue.timed[0][6]];
  const double printed = cells_of_table_3(catalogue, results)[6].printed_efficiency;
  teapot_on_64.total_ns = static_cast<std::uint64_t>(static_cast<double>(teapot_on_64.total_ns) * printed / (printed - 2));
  CHECK(cells_of_table_3(catalogue, results)[6].efficiency == doctest::Approx(printed - 2));
  const Table table = table_3(catalogue, results);
  CHECK(number(table.rows()[6][7]) == doctest::Approx(-2));
  CHECK(table.notes().back() == "Predicted efficiencies differ by 0.11 points on average and 2.00 at worst, 18 cells.");
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
                                             whole(1'397'473), whole(1234), whole(793), whole(database.bytes().size() / 1024),
                                             58.19, 5.5});
  CHECK(table.notes() ==
        std::vector<std::string>{"Teapot: another teapot: theirs is not published.", "Unfinished: 4 of 5 rows are missing."});
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
  CHECK(has_note(table, "on nodes with memories of 4 MiB"));
  CHECK(has_note(table, "did not fit into the memories of 2 and 4 nodes"));
}

TEST_CASE("the notes on the computers of both algorithms are true of their runs") {
  const Catalogue catalogue = catalogue_of(16);
  for (std::size_t column = 1; column < paper_node_counts.size(); ++column) {
    CHECK(catalogue.rings_by_pages[1][column] == catalogue.timed[rings_row][column]);
    for (const std::size_t run :
         {catalogue.rings_by_pages[0][column], catalogue.rings_by_rays[0][column], catalogue.rings_by_rays[1][column]}) {
      CHECK(catalogue.runs[run].node_memory_bytes == std::size_t{4} << 20U);
      CHECK_FALSE(catalogue.runs[run].cache_share.has_value());
    }
  }
}

TEST_CASE("caches have their efficiency, faults and traffic beside what they hold") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results(catalogue.runs.size());
  CacheFigures figures;
  figures.efficiency.fill(50);
  figures.page_rate.fill(1e5);
  set_caches(results, catalogue, 1, figures);
  PaperResult& largest = *results[catalogue.cached[1].back()];
  largest.references = 1'000;
  largest.faults = 77;
  largest.cache_pages = 1800;
  largest.parts.ns = {60, 30, 0, 0, 0, 0, 0, 10, 0, 0, 0};
  const Table table = caches(catalogue, results);
  REQUIRE(table.rows().size() == 10);
  const std::vector<Cell>& last = table.rows().back();
  CHECK(std::vector<Cell>(last.begin(), last.begin() + 3) == std::vector<Cell>{"tetra-9", whole(2895), whole(1800)});
  const std::pair<std::size_t, double> figures_of_last[] = {
      {3, 100 * 2895 / 36189.0}, {4, 50}, {6, 7.7}, {7, 1e5}, {8, 30}, {9, 10}};
  for (const auto& [column, expected] : figures_of_last) {
    CHECK(number(last[column]) == doctest::Approx(expected));
  }
  CHECK(last[5] == Cell(whole(77)));
  CHECK(table.notes().back() == "Unfinished: 10 of 20 rows are missing.");
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
  results[catalogue.by_way(1, RayWay::unchecked)] = unchecked;
  const Table table = ray_ways(catalogue, results);
  REQUIRE(table.rows().size() == 1);
  CHECK(table.rows()[0] ==
        std::vector<Cell>{"rings-4-t1", "no backpressure", 200.0, 50.0, 70.0, 3.0, std::uint64_t{5}, std::uint64_t{9}});
}

TEST_CASE("work items have their seconds and where they go, static first") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results(catalogue.runs.size());
  results[catalogue.items[0]] = result_of_seconds(700);
  results[catalogue.items[0]]->parts.ns = {60, 0, 10, 0, 0, 0, 0, 0, 0, 5, 25};
  results[catalogue.items[3]] = result_of_seconds(604);
  results[catalogue.items_assigned[3]] = result_of_seconds(650);
  const Table table = work_items(catalogue, results);
  REQUIRE(table.rows().size() == 3);
  CHECK(table.rows()[0] == std::vector<Cell>{"static", "nobody", 700.0, 60.0, 0.0, 10.0, 5.0, 25.0, whole(0)});
  CHECK(table.rows()[1][0] == Cell("3x3"));
  CHECK(table.rows()[2][1] == Cell("host"));
  CHECK(table.notes().back() == "Unfinished: 10 of 13 rows are missing.");
}

TEST_CASE("pages of every size have their seconds and traffic, by software and by hardware") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results(catalogue.runs.size());
  const PaperRun& run = catalogue.runs[catalogue.paged_by_hardware[0]];
  CHECK(run.page_size_bytes == 512);
  CHECK(run.machine.cost_ps[static_cast<std::size_t>(core::Charge::cached_lookup)] ==
        run.machine.cost_ps[static_cast<std::size_t>(core::Charge::home_lookup)]);
  results[catalogue.paged_by_hardware[0]] = result_of_seconds(300);
  results[catalogue.paged_by_hardware[0]]->faults = 5;
  results[catalogue.paged_by_hardware[0]]->page_bytes = 2600;
  const Table table = page_sizes(catalogue, results);
  REQUIRE(table.rows().size() == 1);
  CHECK(table.rows()[0] == std::vector<Cell>{"hardware", whole(512), 300.0, 0.0, 0.0, whole(5), whole(2600)});
  CHECK(table.notes().back() == "Unfinished: 7 of 8 rows are missing.");
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
  results[catalogue.timed[3][4]].reset();  // Tetra9's base
  CHECK(cells_of_table_3(catalogue, results).size() == 21);
  CHECK(table_3(catalogue, results).notes().back() == "Unfinished: 3 of 24 rows are missing.");
  CHECK(losses(catalogue, results).notes().back() == "Unfinished: 3 of 24 rows are missing.");
  CHECK(algorithms(catalogue, results).rows().empty());
  CHECK(claims(catalogue, PaperResults(catalogue.runs.size())).rows().empty());
}

}  // namespace dmpc::tests::tables_test
