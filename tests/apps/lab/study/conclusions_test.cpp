#include "apps/lab/study/command.h"

#include <doctest/doctest.h>

namespace dmpc::apps::study_conclusions_test {

namespace {

/// A table of the study's columns, with these numbers by name, row after row.
template <class Study>
Table table_with(const Study& study, const std::vector<std::vector<std::pair<std::string, Cell>>>& rows) {
  Table table("Study", study.columns());
  for (const auto& numbers : rows) {
    std::vector<Cell> row(table.columns().size());
    for (const auto& [name, cell] : numbers) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = table.columns()[i].name == name ? cell : row[i];
      }
    }
    table.add_row(row);
  }
  return table;
}

}  // namespace

TEST_CASE("a table without rows has no conclusion") {
  CHECK(BalanceStudy{}.conclusion(table_with(BalanceStudy{}, {})).empty());
  CHECK(TrafficStudy{}.conclusion(table_with(TrafficStudy{}, {})).empty());
  CHECK(CacheStudy{}.conclusion(table_with(CacheStudy{}, {})).empty());
}

TEST_CASE("traffic is concluded with what is cheaper on the most nodes") {
  const auto sentence = [](std::uint64_t rays, std::uint64_t pages) {
    return TrafficStudy{}.conclusion(
        table_with(TrafficStudy{}, {{{"nodes", std::uint64_t{64}}, {"ray traffic", rays}, {"page traffic", pages}}}));
  };
  CHECK(sentence(4'800'000, 12'000'000) == "On 64 nodes rays move 4.80 MB and pages 12.0 MB: rays are 2.5 times cheaper here.");
  CHECK(sentence(3000, 1000) == "On 64 nodes rays move 3.00 KB and pages 1.00 KB: pages are 3.0 times cheaper here.");
  CHECK(sentence(0, 0) == "On 64 nodes nothing travels.");
}

TEST_CASE("balance is concluded with both kinds of regions") {
  const Table table =
      table_with(BalanceStudy{}, {{{"nodes", std::uint64_t{4}}, {"regions", "subsampled"}, {"average load achieved", 90.0}},
                                  {{"nodes", std::uint64_t{4}}, {"regions", "equal size"}, {"average load achieved", 40.0}}});
  CHECK(BalanceStudy{}.conclusion(table) ==
        "On 4 nodes the average load is 90.0 % with regions by the subsampled picture, and 40.0 % with regions of equal size.");
}

TEST_CASE("caches are concluded with the size from which lru is good") {
  const auto row = [](std::uint64_t pages, std::uint64_t lru, std::uint64_t optimum) {
    return std::vector<std::pair<std::string, Cell>>{{"cache pages", pages},
                                                     {"share of database", 1.0 * static_cast<double>(pages)},
                                                     {"faults lru", lru},
                                                     {"faults optimum", optimum}};
  };
  CHECK(CacheStudy{}.conclusion(table_with(CacheStudy{}, {row(1, 1000, 1000), row(4, 500, 300), row(16, 105, 100)})) ==
        "From caches of 16 pages on (16.0 % of the database) lru is within 10 % of the best that any policy could do; it faults "
        "10.5 % as often as with 1 page.");
}

}  // namespace dmpc::apps::study_conclusions_test
