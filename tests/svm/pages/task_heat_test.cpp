#include "svm/pages/task_heat.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/base/expect.h"
#include "svm/pages/run_tasks.h"
#include "tests/svm/pages/page_rank.h"

namespace dmpc::svm::task_heat_test {

namespace {

constexpr std::uint32_t heated_vertices = 300;
constexpr std::size_t heated_page_bytes = 512;

/// A round of ranks on so many nodes, with the heat of its tasks.
struct HeatedRanks {
  explicit HeatedRanks(TaskOptions options) : heat(heated_vertices) {
    const tests::Graph graph = tests::random_graph(heated_vertices, 6, 1);
    tests::RankPages pages(graph, heated_page_bytes);
    pages.give(std::vector<double>(heated_vertices, 1));
    options.page_size_bytes = heated_page_bytes;
    figures = run_tasks<tests::RankTask>(pages.bytes(), heated_vertices, options, {.heat = &heat});
  }

  TaskHeat heat;
  TaskReport<double> figures;
};

}  // namespace

TEST_CASE("the heat of a node's tasks adds up to what the node counted, whoever waits for whose page") {
  for (const std::uint32_t node_count : {1U, 2U, 5U}) {
    for (const std::uint32_t in_flight : {1U, 16U}) {
      for (const bool is_disturbed : {false, true}) {
        TaskOptions options{.computer = {.node_count = node_count}, .cache_pages = 2, .in_flight = in_flight};
        options.computer.chaos = is_disturbed ? std::optional(nodes::chaos_of(3)) : std::nullopt;
        const HeatedRanks ranks(options);
        std::vector<TaskTaken> by_node(node_count);
        for (const TaskTaken& taken : ranks.heat) {
          TaskTaken& sum = by_node[taken.node];
          sum.references += taken.references;
          sum.faults += taken.faults;
          for (std::size_t i = 0; i < nodes::charge_count; ++i) {
            sum.charges.count[i] += taken.charges.count[i];
          }
        }
        for (std::uint32_t node = 0; node < node_count; ++node) {
          CHECK(by_node[node].references == ranks.figures.pages[node].references);
          CHECK(by_node[node].faults == ranks.figures.pages[node].faults);
          CHECK(by_node[node].charges.count == ranks.figures.charges[node].count);
        }
      }
    }
  }
}

TEST_CASE("a task's look-ups are its own, and a node alone has no faults") {
  const HeatedRanks alone({.computer = {.node_count = 1}}), starved({.computer = {.node_count = 3}, .cache_pages = 1});
  const tests::Graph graph = tests::random_graph(heated_vertices, 6, 1);
  for (std::uint32_t vertex = 0; vertex < heated_vertices; ++vertex) {
    // Where its edges begin and end, and an edge with what its other end gives.
    const std::uint64_t words = 2 + 2 * graph.sources[vertex].size();
    CHECK(alone.heat[vertex].references == words);
    CHECK(alone.heat[vertex].faults == 0);
    CHECK(starved.heat[vertex].references == words);
    CHECK(starved.heat[vertex].steps >= alone.heat[vertex].steps);
  }
  CHECK(starved.heat.front().node == 0);
  CHECK(starved.heat.back().node == 2);
}

TEST_CASE("heat without a place for each task is a mistake") {
  TaskHeat heat(1);
  const tests::Graph graph = tests::random_graph(2, 1, 1);
  tests::RankPages pages(graph, heated_page_bytes);
  pages.give({1, 1});
  CHECK_THROWS_AS(run_tasks<tests::RankTask>(pages.bytes(), 2, {.page_size_bytes = heated_page_bytes}, {.heat = &heat}),
                  core::InternalError);
}

}  // namespace dmpc::svm::task_heat_test
