#include "dataflow/units/unit_primaries.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests::unit_primaries_test {
namespace {

using dataflow::AssignedPrimaries;
using dataflow::PrimaryRun;
using dataflow::UnitPrimaries;

/// A node with room for so many runs, of two units at a time.
struct UnitPrimariesBench {
  UnitPrimariesBench(std::size_t room, const std::vector<PrimaryRun>& runs, const std::vector<std::uint32_t>& runs_of_unit)
      : memory(UnitPrimaries::layout({.units = 2, .runs = room})),
        primaries(memory, {.units = 2, .runs = room}, runs, runs_of_unit, {0, 1}) {}

  std::vector<std::uint64_t> take_all() {
    std::vector<std::uint64_t> numbers;
    while (!primaries.empty()) {
      numbers.push_back(primaries.take());
    }
    return numbers;
  }

  nodes::LocalMemory memory;
  UnitPrimaries primaries;
};

}  // namespace

TEST_CASE("a node without units has no primary rays of units, and takes no memory for them") {
  const nodes::MemoryPlan plan = UnitPrimaries::layout({});
  CHECK(plan.total() == 0);
  nodes::LocalMemory memory(plan);
  UnitPrimaries primaries(memory, {}, {}, {}, {});
  CHECK(primaries.empty());
  CHECK(primaries.free_runs() == 0);
  CHECK_THROWS_AS(primaries.take(), core::InternalError);
}

TEST_CASE("primary rays start in the order of the picture, whatever their unit") {
  UnitPrimariesBench bench(4, {{0, 2}, {20, 1}, {3, 1}, {10, 2}}, {0, 2, 0, 2});
  CHECK(bench.memory.used().total() == nodes::MemoryPlan(UnitPrimaries::layout({.units = 2, .runs = 4})).total());
  CHECK(bench.primaries.left() == 6);
  CHECK(bench.primaries.left_of(1) == 3);
  CHECK(bench.primaries.left_of(3) == 3);
  CHECK(bench.primaries.left_of(0) == 0);
  CHECK(bench.take_all() == std::vector<std::uint64_t>{0, 1, 3, 10, 11, 20});
  CHECK_THROWS_AS(bench.primaries.take(), core::InternalError);
}

TEST_CASE("what is given of a unit is what has not started, and starts here no more") {
  UnitPrimariesBench bench(3, {{0, 4}, {8, 1}, {2, 3}}, {2, 1});
  for (int i = 0; i < 3; ++i) {
    bench.primaries.take();  // 0, 1, 2
  }
  const AssignedPrimaries given = bench.primaries.give(0);
  REQUIRE(given.count == 2);
  CHECK(given.runs[0].first == 3);
  CHECK(given.runs[0].count == 1);
  CHECK(given.runs[1].first == 8);
  CHECK(bench.primaries.left_of(0) == 0);
  CHECK(bench.take_all() == std::vector<std::uint64_t>{2, 3, 4});
}

TEST_CASE("the unit with most rays left is known, and asked for where there is one") {
  UnitPrimariesBench bench(2, {{0, 5}, {5, 4}}, {0, 1, 1});
  CHECK(bench.primaries.largest_unit() == 1);
  bench.primaries.take();
  bench.primaries.take();
  CHECK(bench.primaries.largest_unit() == 2);
  bench.take_all();
  CHECK_THROWS_AS(bench.primaries.largest_unit(), core::InternalError);
}

TEST_CASE("of a unit without primary rays nothing is given") {
  UnitPrimariesBench bench(1, {{0, 1}}, {1, 0});
  CHECK(bench.primaries.give(1).count == 0);
  CHECK(bench.primaries.left() == 1);
}

TEST_CASE("a unit's runs go along packet by packet") {
  std::vector<PrimaryRun> runs;
  for (std::uint64_t i = 0; i < 100; ++i) {
    runs.push_back({10 * i, 2});
  }
  UnitPrimariesBench donor(100, runs, {100}), recipient(100, {}, {0});
  CHECK(recipient.primaries.free_runs() == 100);
  while (donor.primaries.runs_of(0) > 0) {
    recipient.primaries.put(0, donor.primaries.give(0));
  }
  CHECK(donor.primaries.empty());
  CHECK(recipient.primaries.left() == 200);
  CHECK(recipient.primaries.free_runs() == 0);
  CHECK(recipient.primaries.take() == 0);
}

TEST_CASE("there is room for a unit where all rays have started, even between two packets, and for no more than that") {
  UnitPrimariesBench bench(2, {{0, 1}, {5, 1}}, {1, 1});
  CHECK(bench.primaries.free_runs() == 0);
  bench.take_all();
  CHECK(bench.primaries.free_runs() == 2);
  AssignedPrimaries assigned{.samples = {0, 1}, .count = 1};
  for (const std::uint64_t first : {30U, 40U, 50U}) {
    assigned.runs[0] = {first, 2};
    bench.primaries.put(7, assigned);
    CHECK(bench.take_all() == std::vector<std::uint64_t>{first, first + 1});
  }
  assigned.count = 2;
  bench.primaries.put(7, assigned);
  CHECK_THROWS_AS(bench.primaries.put(7, assigned), core::InternalError);
  CHECK_THROWS_AS(bench.primaries.put(6, AssignedPrimaries{.samples = {0, 1}}), core::InternalError);
}

TEST_CASE("runs that are nobody's, or more than there is room for, are a fault") {
  CHECK_THROWS_AS(UnitPrimariesBench(1, {{0, 1}, {5, 1}}, {2}), core::InternalError);
  CHECK_THROWS_AS(UnitPrimariesBench(2, {{0, 1}, {5, 1}}, {1}), core::InternalError);
  CHECK_THROWS_AS(UnitPrimariesBench(3, {{0, 1}, {5, 1}, {9, 1}}, {1, 1, 1}), core::InternalError);
}

}  // namespace dmpc::tests::unit_primaries_test
