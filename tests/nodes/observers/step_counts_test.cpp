#include "nodes/observers/step_counts.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <numeric>
#include <vector>

namespace dmpc::nodes::step_counts_test {

namespace {

std::vector<std::uint64_t> row_of(const StepCounts& counts, std::uint32_t number) {
  const auto row = counts.row(number);
  return {row.begin(), row.end()};
}

using Row = std::vector<std::uint64_t>;

}  // namespace

TEST_CASE("what comes is counted in its step, by its number") {
  StepCounts counts(10, 4, 4);
  counts.add(7, 0, 2);
  counts.add(7, 1023, 3);
  counts.add(7, 1024, 1);
  counts.add(2, 3000, 9);
  CHECK(counts.step_ns() == 1024);
  CHECK(row_of(counts, 7) == Row{5, 1, 0, 0});
  CHECK(row_of(counts, 2) == Row{0, 0, 9, 0});
  CHECK(row_of(counts, 3).empty());
}

TEST_CASE("steps double as a run goes on, and nothing is lost by it") {
  StepCounts counts(2, 2, 4);
  std::uint64_t given = 0;
  for (std::uint64_t at_ns = 0; at_ns < 1'000'000; at_ns += 777) {
    counts.add(0, at_ns, 3);
    given += 3;
  }
  CHECK(counts.step_ns() == 262'144);
  const Row row = row_of(counts, 0);
  CHECK(std::accumulate(row.begin(), row.end(), std::uint64_t{0}) == given);
  CHECK(row[0] == 3 * ((262'144 + 776) / 777));
}

TEST_CASE("of what is raised a longer step has the larger of two") {
  StepCounts levels(1, 1, 2);
  levels.raise(0, 0, 5);
  levels.raise(0, 1500, 8);
  levels.raise(0, 1600, 2);
  CHECK(row_of(levels, 0) == Row{5, 8});
  levels.raise(0, 2048, 1);
  CHECK(row_of(levels, 0) == Row{8, 1});
}

TEST_CASE("more numbers than rows are said") {
  StepCounts counts(3, 2, 2);
  counts.add(0, 0, 1);
  counts.add(1, 0, 1);
  CHECK(counts.is_complete());
  counts.add(2, 0, 1);
  CHECK_FALSE(counts.is_complete());
  CHECK(row_of(counts, 2).empty());
  CHECK(row_of(counts, 1) == Row{1, 0});
}

}  // namespace dmpc::nodes::step_counts_test
