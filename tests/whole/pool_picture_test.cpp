// One picture on a pool: whatever the strategy, the nodes and the threads that drive them in turn, the film is the reference
// renderer's, and what does not hang on the schedule is counted as with a thread for each node.
#include <doctest/doctest.h>

#include <cstdint>
#include <optional>

#include "dataflow/run.h"
#include "nodes/chaos.h"
#include "nodes/computer_request.h"
#include "svm/run.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::pool_picture_test {
namespace {

nodes::ComputerRequest computer(std::uint32_t nodes, const std::optional<std::uint32_t>& threads = std::nullopt,
                                const std::optional<std::uint64_t>& seed = std::nullopt) {
  nodes::ComputerRequest request;
  request.node_count = nodes;
  request.pool_threads = threads;
  if (seed) {
    request.chaos = nodes::chaos_of(*seed);
  }
  return request;
}

void check_strategies(const Subject& subject, const nodes::ComputerRequest& on) {
  CAPTURE(on.node_count);
  CAPTURE(*on.pool_threads);
  CHECK(outcome_of(run_svm(subject, {.computer = on})) == subject.outcome());
  CHECK(outcome_of(run_replicated(subject, {.computer = on})) == subject.outcome());
  CHECK(outcome_of(run_dataflow(subject, {.computer = on})) == subject.outcome());
}

core::BuildOptions extents() {
  core::BuildOptions options;
  options.structure = core::Structure::extents;
  return options;
}

TEST_CASE("a pool makes the same picture by every strategy, of fewer nodes than threads and of many more") {
  const Subject subject(mirrors_and_glass(), {.width = 24, .height = 20});
  const Subject one_tree(mirrors_and_glass(), {.width = 24, .height = 20}, extents());
  for (const std::uint32_t nodes : {1U, 2U, 7U, 64U}) {
    for (const std::uint32_t threads : {1U, 2U, 5U}) {
      check_strategies(subject, computer(nodes, threads));
      CHECK(outcome_of(run_forest(one_tree, {.computer = computer(nodes, threads)})) == one_tree.outcome());
    }
  }
}

TEST_CASE("a pool that is disturbed makes the same picture") {
  const Subject subject(mirrors_and_glass(), {.width = 12, .height = 10});
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    CAPTURE(seed);
    check_strategies(subject, computer(9, static_cast<std::uint32_t>(1 + seed % 3), seed));
  }
}

TEST_CASE("one node counts on a pool what it counts on a thread of its own, and has as much memory") {
  const Subject subject(mirrors_and_glass(), {.width = 24, .height = 20});
  const svm::Report threads = run_svm(subject, {.computer = computer(1)});
  const svm::Report pool = run_svm(subject, {.computer = computer(1, 1)});
  CHECK(pool.film.hash() == threads.film.hash());
  CHECK(nodes::total(pool.sent()).packets == nodes::total(threads.sent()).packets);
  CHECK(pool.nodes[0].memory_used.bytes == threads.nodes[0].memory_used.bytes);
  CHECK(outcome_of(pool) == outcome_of(threads));
}

}  // namespace
}  // namespace dmpc::tests::pool_picture_test
