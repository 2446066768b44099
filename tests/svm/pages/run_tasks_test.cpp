#include "svm/pages/run_tasks.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/base/expect.h"
#include "core/trace/charge.h"
#include "svm/pages/observers/miss_curve.h"
#include "svm/pages/observers/optimum.h"
#include "svm/pages/task_program.h"
#include "tests/svm/pages/page_rank.h"

namespace dmpc::svm::run_tasks_test {

namespace {

using tests::Graph;
using tests::RankPages;
using tests::RankTask;

constexpr std::uint32_t rank_vertices = 600, rank_rounds = 3;
constexpr std::size_t rank_page_bytes = 512;

const Graph& graph() {
  static const Graph made = tests::random_graph(rank_vertices, 6, 1);
  return made;
}

TaskOptions small_computer(std::uint32_t node_count, std::uint32_t cache_pages = 3) {
  return {.computer = {.node_count = node_count}, .page_size_bytes = rank_page_bytes, .cache_pages = cache_pages};
}

/// Round after round; figures are the last one's.
TaskReport<double> ranked(const TaskOptions& options, const TaskWatching& watching = {}, std::uint32_t rounds = rank_rounds) {
  RankPages pages(graph(), options.page_size_bytes);
  TaskReport<double> report;
  report.results.assign(rank_vertices, 1);
  for (std::uint32_t round = 0; round < rounds; ++round) {
    pages.give(report.results);
    report = run_tasks<RankTask>(pages.bytes(), rank_vertices, options, watching);
  }
  return report;
}

nodes::Machine slow_network() {
  nodes::Machine machine;
  machine.short_message = machine.long_message = {.send_ns = 100, .latency_ns = 1000, .receive_ns = 100, .byte_ps = 1000};
  machine.cost_ps[static_cast<std::size_t>(core::Charge::cell_step)] = 5000;
  return machine;
}

}  // namespace

TEST_CASE("ranks over pages are those of one memory, to the last bit, on every computer, with every cache and policy") {
  const std::vector<double> expected = tests::ranks_in_one_memory(graph(), rank_rounds);
  for (const std::uint32_t node_count : {1U, 2U, 3U, 8U}) {
    for (const std::uint32_t cache_pages : {1U, 7U, 1000U}) {
      CHECK(ranked(small_computer(node_count, cache_pages)).results == expected);
      TaskOptions modelled = small_computer(node_count, cache_pages);
      modelled.computer.machine = slow_network();
      CHECK(ranked(modelled).results == expected);
    }
  }
  for (std::size_t policy = 0; policy < policy_kinds().size(); ++policy) {
    TaskOptions options = small_computer(3);
    options.replacement = static_cast<Replacement>(policy);
    options.in_flight = 1;
    CHECK(ranked(options).results == expected);
  }
}

TEST_CASE("disturbed, too") {
  const std::vector<double> expected = tests::ranks_in_one_memory(graph(), 1);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    INFO("seed ", seed);
    TaskOptions options = small_computer(4, 2);
    options.computer.chaos = nodes::chaos_of(seed);
    CHECK(ranked(options, {}, 1).results == expected);
  }
}

TEST_CASE("a node alone asks nobody, and one with all pages in its cache asks for each once") {
  CHECK(ranked(small_computer(1)).all_pages().faults == 0);
  const TaskReport<double> full = ranked(small_computer(2, 1000));
  const PageCounters pages = full.all_pages();
  CHECK(pages.evictions == 0);
  CHECK(pages.faults > 0);
  CHECK(pages.faults <= RankPages(graph(), rank_page_bytes).bytes().size() / rank_page_bytes);
  CHECK(ranked(small_computer(2, 1)).all_pages().faults > pages.faults);
}

TEST_CASE("references are what tasks look up, each counted once, whatever the cache") {
  std::uint64_t words = 2 * rank_vertices;  // where each vertex's edges begin and end
  for (const auto& sources : graph().sources) {
    words += 2 * sources.size();  // an edge, and what its other end gives
  }
  for (const std::uint32_t cache_pages : {1U, 7U, 1000U}) {
    CHECK(ranked(small_computer(3, cache_pages), {}, 1).all_pages().references == words);
  }
}

TEST_CASE("references that one run records tell what other caches fault, of every policy") {
  std::vector<ReferenceLog> logs(3);
  TaskOptions options = small_computer(3);
  options.in_flight = 1;
  ranked(options, {.reference_logs = &logs}, 1);
  for (const std::uint32_t cache_pages : {1U, 5U, 12U}) {
    for (const Replacement policy : {Replacement::lru, Replacement::fifo}) {
      TaskOptions other = options;
      other.cache_pages = cache_pages;
      other.replacement = policy;
      const TaskReport<double> report = ranked(other, {}, 1);
      for (std::uint32_t node = 0; node < 3; ++node) {
        CHECK(policy_misses(policy, logs[node].pages(), cache_pages, node) == report.pages[node].faults);
        CHECK((policy != Replacement::lru || MissCurve(logs[node].pages()).misses(cache_pages) == report.pages[node].faults));
      }
    }
  }
}

TEST_CASE("on a modelled machine a run is repeated to the last event, and takes the time of its operations and its pages") {
  TaskOptions options = small_computer(4);
  options.computer.machine = slow_network();
  const TaskReport<double> first = ranked(options, {}, 1), again = ranked(options, {}, 1);
  CHECK(first.virtual_time->hash == again.virtual_time->hash);
  std::uint64_t edges = 0, computing_ns = 0;
  for (const auto& sources : graph().sources) {
    edges += sources.size();
  }
  for (std::uint32_t node = 0; node < 4; ++node) {
    computing_ns += first.virtual_time->nodes[node].computing_ns;
  }
  CHECK(computing_ns == 5 * edges);
  TaskOptions larger = options;
  larger.cache_pages = 1000;
  CHECK(ranked(larger, {}, 1).virtual_time->total_ns < first.virtual_time->total_ns);
}

TEST_CASE("nodes without tasks serve their pages") {
  RankPages pages(graph(), rank_page_bytes);
  pages.give(std::vector<double>(rank_vertices, 1));
  const auto report = run_tasks<RankTask>(pages.bytes(), 2, small_computer(8));
  CHECK(report.results.size() == 2);
  CHECK(report.results[1] == tests::ranks_in_one_memory(graph(), 1)[1]);
}

TEST_CASE("what is out of range is refused with what would do, and a memory that is too small with what a node takes") {
  RankPages pages(graph(), rank_page_bytes);
  const auto run_with = [&](const TaskOptions& options, std::uint32_t count = 1) {
    run_tasks<RankTask>(pages.bytes(), count, options);
  };
  CHECK_THROWS_WITH_AS(run_with(small_computer(0)), doctest::Contains("node_count=0: expected 1 to 4096"), core::UsageError);
  CHECK_THROWS_WITH_AS(run_with(small_computer(1), 0), doctest::Contains("task_count=0"), core::UsageError);
  TaskOptions options = small_computer(2);
  options.in_flight = 0;
  CHECK_THROWS_WITH_AS(run_with(options), doctest::Contains("in_flight=0: expected 1 to 4096"), core::UsageError);
  options = small_computer(2, 0);
  CHECK_THROWS_WITH_AS(run_with(options), doctest::Contains("cache_pages=0"), core::UsageError);
  options = small_computer(2);
  options.page_size_bytes = 700;
  CHECK_THROWS_WITH_AS(run_with(options), doctest::Contains("a page is a power of two"), core::UsageError);
  options.page_size_bytes = 65536;
  CHECK_THROWS_WITH_AS(run_with(options), doctest::Contains("expected whole pages of 65536"), core::UsageError);
  options = small_computer(2);
  CHECK_THROWS_WITH_AS(TaskPlan(options, 0xffffffffULL * options.page_size_bytes, 1, {}),
                       doctest::Contains("page_count=4294967295: expected 1 to 4294967294"), core::UsageError);
  options.computer.node_memory_bytes = 1000;
  CHECK_THROWS_WITH_AS(run_with(options), doctest::Contains("a node takes "), core::CapacityError);
}

TEST_CASE("a plan's memory is what a node takes, to the byte") {
  const RankPages pages(graph(), rank_page_bytes);
  const TaskKind<Pager> ranks = task_kind<Pager, RankTask>();
  const TaskPlan plan(small_computer(3), pages.bytes().size(), rank_vertices, ranks.sizes);
  for (std::uint32_t index = 0; index < 3; ++index) {
    nodes::MemoryPlan without_mailbox = plan.node_memory(index);
    without_mailbox[nodes::Category::mailbox] = 0;
    tests::Post post;
    nodes::LocalMemory memory(without_mailbox);
    nodes::Node node(nodes::NodeId{index}, 4, memory, post);
    const TaskProgram<Pager> program(node, plan, pages.bytes(), ranks);
    CHECK(memory.used().total() == without_mailbox.total());
  }
}

}  // namespace dmpc::svm::run_tasks_test
