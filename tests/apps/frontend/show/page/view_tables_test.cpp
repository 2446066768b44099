#include "apps/frontend/show/page/view_tables.h"

#include <doctest/doctest.h>

#include <vector>

#include "tests/apps/show/watched.h"

namespace dmpc::apps::html::view_tables_test {

namespace {

double real(const Cell& cell) { return std::get<double>(cell); }

const std::vector<std::string> six_works = {"a", "b", "c", "d", "e", "f"};

/// The sum of a row's numbers but the last.
double sum_before_last(const std::vector<Cell>& row) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < row.size(); ++i) {
    sum += real(row[i]);
  }
  return sum;
}

/// So many fetches, each as long as its number says, half of it service.
svm::Fetches fetches_up_to(std::uint64_t count) {
  svm::Fetches fetches{.peer_count = 2, .by_pair = {0, 3, 1, 0}, .by_page = {1, 0, 2, 1}};
  for (std::uint64_t i = 1; i <= count; ++i) {
    fetches.sample.push_back({.part_ns = {0, 500 * i, 0, 500 * i}});
  }
  return fetches;
}

}  // namespace

TEST_CASE("fetches of every length have parts that add up") {
  const Table table = fetch_table(fetches_up_to(1000));
  REQUIRE(table.rows().size() == 4);
  CHECK(table.columns().size() == 4);  // parts that no fetch has are left out
  for (const std::vector<Cell>& row : table.rows()) {
    CHECK(sum_before_last(row) == doctest::Approx(real(row.back())));
  }
  CHECK(real(table.rows()[0].back()) == doctest::Approx(500.5));
  CHECK(real(table.rows()[1].back()) == doctest::Approx(500.5));
  CHECK(real(table.rows()[2].back()) == doctest::Approx(950.5));
  CHECK(real(table.rows()[3].back()) == doctest::Approx(990.5));
}

TEST_CASE("few fetches are their own percentiles, and none are no rows") {
  const Table one = fetch_table(fetches_up_to(1));
  CHECK(real(one.rows()[3].back()) == 1);
  CHECK(fetch_table(fetches_up_to(0)).rows().empty());
  CHECK(fetch_part_table(fetches_up_to(0)).rows().empty());
}

TEST_CASE("each part has percentiles of its own") {
  const Table table = fetch_part_table(fetches_up_to(100));
  CHECK(table.rows().size() == 4);
  CHECK(std::get<std::string>(table.rows()[1][0]) == "service");
  CHECK(real(table.rows()[1][2]) == doctest::Approx(25.5));
  CHECK(real(table.rows()[1][5]) == doctest::Approx(50));
}

TEST_CASE("the hottest pages come first, with their share") {
  const Table table = page_table(fetches_up_to(0));
  REQUIRE(table.rows().size() == 3);
  CHECK(std::get<std::uint64_t>(table.rows()[0][0]) == 2);
  CHECK(real(table.rows()[0][3]) == 50);
  CHECK(std::get<std::uint64_t>(table.rows()[1][0]) == 0);
  const Table shares = page_share_table(fetches_up_to(0));
  CHECK(real(shares.rows().front()[2]) == 50);
  CHECK(real(shares.rows().back()[2]) == 100);
  CHECK(std::get<std::uint64_t>(shares.rows().back()[0]) == 4);
}

TEST_CASE("steps have the nodes' time without the host's") {
  nodes::ActivitySteps steps{.step_ns = 1000, .nodes = {{{500, 0, 0, 0, 0, 0}}, {{0, 250, 0, 0, 0, 0}}, {{9, 9, 9, 9, 9, 9}}}};
  const Table table = step_table(steps, six_works);
  REQUIRE(table.rows().size() == 1);
  CHECK(real(table.rows()[0][1]) == 25);
  CHECK(real(table.rows()[0][2]) == 12.5);
  CHECK(real(table.rows()[0][3]) == 0);
  CHECK(real(table.rows()[0][0]) == 0);
  const NumberMap map = step_map(steps);
  CHECK(map.values == std::vector<double>{50, 25});
  CHECK(table.columns()[2].name == "b");
  CHECK(map.most == 100);
  CHECK(step_plot(steps, six_works).bar_width == 0.001);
}

TEST_CASE("steps have waits by name, those of which there are any, and plots what any node did or waited for") {
  const nodes::ActivitySteps steps{.step_ns = 1000,
                                   .nodes = {{{500, 0, 0, 0, 0, 0}}, {{0, 0, 0, 0, 0, 0}}, {{9, 9, 9, 9, 9, 9}}},
                                   .waits = {{{0, 100, 0, 0, 0, 0, 0}}, {{0, 0, 0, 0, 0, 0, 0}}, {{9, 9, 9, 9, 9, 9, 9}}}};
  const std::vector<std::string> waits = {"p", "q", "r", "s", "t", "u", "v"};
  const Table table = step_table(steps, six_works, waits);
  REQUIRE(table.columns().size() == 8);
  CHECK(table.columns()[7].name == "q");
  CHECK(real(table.rows()[0][7]) == 5);
  const Plot plot = step_plot(steps, six_works, waits);
  REQUIRE(plot.series.size() == 2);
  CHECK(plot.series[1].title == "q");
}

TEST_CASE("a sample tells nothing of caches that would hold next to nothing of it") {
  const MissEstimate estimate{.every = 8};
  const Table table = miss_table(estimate, 1000, 10, 20, 1);
  CHECK(std::get<std::uint64_t>(table.rows()[0][0]) == 20);
  CHECK(std::holds_alternative<std::monostate>(table.rows()[0][1]));
  CHECK(std::holds_alternative<std::monostate>(table.rows()[0][2]));
  CHECK(std::get<double>(table.rows()[0][3]) == 10);
  CHECK(std::get<std::uint64_t>(table.rows()[1][0]) >= 32);
  CHECK(std::get<std::uint64_t>(table.rows().back()[0]) == 1000);
}

TEST_CASE("a table of misses has the run's own cache among ever larger ones") {
  const Watched watched(starved(modelled()));
  const svm::PageCounters pages = std::get<svm::Report>(*watched.report).pages();
  const auto page_count = static_cast<std::uint32_t>(watched.database.page_count());
  const Table table = miss_table(*watched.view().misses, page_count, pages.references, 5, pages.faults);
  std::uint64_t before = pages.references, own_rows = 0;
  for (const std::vector<Cell>& row : table.rows()) {
    CHECK(std::get<std::uint64_t>(row[1]) <= before);
    before = std::get<std::uint64_t>(row[1]);
    own_rows += std::holds_alternative<double>(row[3]) ? 1 : 0;
  }
  CHECK(own_rows == 1);
}

}  // namespace dmpc::apps::html::view_tables_test
