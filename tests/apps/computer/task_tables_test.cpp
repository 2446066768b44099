
#include <doctest/doctest.h>

#include <variant>
#include <vector>

#include "apps/computer/program_tables.h"

namespace dmpc::apps::html::task_tables_test {

namespace {

/// `node_count` nodes, each with its part in a row of tasks that began `faults` faults each.
struct Heated {
  Heated(std::size_t node_count, const std::vector<std::uint64_t>& faults) {
    record.nodes.resize(node_count);
    for (std::size_t node = 0; node < node_count; ++node) {
      for (std::size_t task = faults.size() * node / node_count; task < faults.size() * (node + 1) / node_count; ++task) {
        record.tasks.heat.push_back(
            {.node = static_cast<std::uint32_t>(node), .steps = 1, .references = 8, .faults = faults[task]});
      }
    }
  }

  ProgramOptions options;
  Vocabulary vocabulary = vocabulary_of_tasks({{"addition", 2}});
  ProgramRecord record{.name = "heated", .options = options, .vocabulary = vocabulary};
};

}  // namespace

TEST_CASE("a heat map has a row for each node and a place for each of its tasks") {
  const NumberMap map = heat_map(Heated(2, {1, 2, 3, 4, 5, 6}).record, TaskHeatKind::faults);
  CHECK(map.rows == 2);
  CHECK(map.columns == 3);
  CHECK(map.values == std::vector<double>{1, 2, 3, 4, 5, 6});
  CHECK(map.column_label == "its tasks in order");
}

TEST_CASE("where a node has one task more than another, some places are the mean of two, and none is empty") {
  const NumberMap map = heat_map(Heated(2, {1, 3, 5, 7, 9}).record, TaskHeatKind::faults);
  CHECK(map.values == std::vector<double>{1, 3, 5, 8});
  CHECK(map.column_label == "its tasks in order, in 2 parts");
}

TEST_CASE("many tasks have few places, and nodes without tasks have nothing") {
  CHECK(heat_map(Heated(1, std::vector<std::uint64_t>(1000, 3)).record, TaskHeatKind::faults).values ==
        std::vector<double>(128, 3));
  CHECK(heat_map(Heated(3, {7}).record, TaskHeatKind::references).values == std::vector<double>{0, 0, 8});
}

TEST_CASE("only heat that says something is shown") {
  CHECK(heat_kinds_of(Heated(1, {0, 0}).record) == std::vector<TaskHeatKind>{TaskHeatKind::references});
  CHECK(heat_kinds_of(Heated(1, {1}).record) == std::vector<TaskHeatKind>{TaskHeatKind::faults, TaskHeatKind::references});
}

TEST_CASE("heat is concluded with the share of the hottest tasks") {
  CHECK(heat_conclusion(Heated(1, {9, 1, 1, 1, 1, 1, 1, 1, 1, 1}).record, TaskHeatKind::faults) ==
        "The tenth of the tasks with the most faults had 50 % of all.");
}

TEST_CASE("the hottest tasks come first, of equal ones the first, and twenty at most") {
  Heated heated(1, std::vector<std::uint64_t>(30, 0));
  heated.record.tasks.heat[7].references = 9;
  const Table table = hottest_tasks(heated.record);
  REQUIRE(table.rows().size() == 20);
  CHECK(std::get<std::uint64_t>(table.rows()[0][0]) == 7);
  CHECK(std::get<std::uint64_t>(table.rows()[1][0]) == 0);
  CHECK(table.title() == "The tasks with the most look-ups");
}

TEST_CASE("all operations together are the nodes' computing, those of pages included") {
  Heated heated(1, {1});
  nodes::Machine& machine = heated.options.computer.machine.emplace();
  machine.cost_ps[static_cast<std::size_t>(charge_of(0))] = 4000;
  machine.cost_ps[static_cast<std::size_t>(core::Charge::page_install)] = 1000;
  heated.record.nodes[0].charges[charge_of(0)] = 10;
  heated.record.nodes[0].charges[core::Charge::page_install] = 5;
  const Table table = operation_table(operations_of(heated.record), &machine);
  REQUIRE(table.rows().size() == 4);
  double sum_ms = 0;
  for (const std::vector<Cell>& row : table.rows()) {
    sum_ms += std::get<double>(row.back());
  }
  CHECK(sum_ms == doctest::Approx(45e-6));
  CHECK(std::get<double>(table.rows()[0][2]) == 2);
  CHECK(std::holds_alternative<std::monostate>(table.rows()[3][2]));
}

}  // namespace dmpc::apps::html::task_tables_test
