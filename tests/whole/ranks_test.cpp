// One picture on several ranks, too: the same node programs over the loopback fabric.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "nodes/ranks/rank_links.h"
#include "tests/support/loopback_ranks.h"
#include "tests/support/scaled.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace {

using namespace dmpc;
using tests::scaled_edge;
using tests::Subject;

constexpr std::uint32_t rank_counts[] = {1, 2, 3, 5};

/// What rank 0 has to report of render(subject, computer), which all call.
template <class Render>
auto on_ranks(std::uint32_t rank_count, std::uint32_t node_count, const Render& render,
              const nodes::LoopbackTrouble& trouble = {}) {
  auto results = tests::on_ranks(rank_count, trouble, [&](nodes::Fabric& fabric) {
    nodes::RankLinks links(fabric);
    return render(nodes::ComputerRequest{.node_count = node_count, .ranks = &links});
  });
  for (const auto& result : results) {
    CHECK(result.failure_text() == "");
  }
  return std::move(results.front().value.value());
}

Subject subject_of(const core::Scene& scene) {
  return Subject(scene, {.width = scaled_edge(40), .height = scaled_edge(32), .samples = 2}, {.page_size_bytes = 1024});
}

TEST_CASE("every strategy gives one picture on any number of ranks, and the reports of all nodes") {
  for (const core::Scene& scene : {tests::mirrors_and_glass(), tests::built_in("gears-1")}) {
    const Subject subject = subject_of(scene);
    for (const std::uint32_t ranks : rank_counts) {
      for (const std::uint32_t nodes : {5U, 7U, 16U}) {
        CAPTURE(scene.name);
        CAPTURE(ranks);
        CAPTURE(nodes);
        const auto svm = on_ranks(ranks, nodes, [&](const nodes::ComputerRequest& computer) {
          return run_svm(subject, {.computer = computer, .pages = {.cache_pages = 3}});
        });
        CHECK(outcome_of(svm) == subject.outcome());
        CHECK(svm.nodes.size() == nodes);
        const auto replicated = on_ranks(ranks, nodes, [&](const nodes::ComputerRequest& computer) {
          return run_replicated(subject, {.computer = computer});
        });
        CHECK(outcome_of(replicated) == subject.outcome());
        const auto dataflow = on_ranks(
            ranks, nodes, [&](const nodes::ComputerRequest& computer) { return run_dataflow(subject, {.computer = computer}); });
        CHECK(outcome_of(dataflow) == subject.outcome());
        CHECK(dataflow.nodes.size() == nodes);
      }
    }
  }
}

TEST_CASE("questions travel between ranks, and samples follow where a pass before has found the picture uneven") {
  const core::Scene scene = tests::mirrors_and_glass();
  const Subject tree(scene, {.width = scaled_edge(24), .height = scaled_edge(20)},
                     {.page_size_bytes = 1024, .structure = core::Structure::extents});
  const Subject refined(scene, {.width = 12, .height = 9, .samples = 2, .refinement = {.error = 0.03}},
                        {.page_size_bytes = 1024});
  for (const std::uint32_t ranks : rank_counts) {
    CAPTURE(ranks);
    const auto forest =
        on_ranks(ranks, 7, [&](const nodes::ComputerRequest& computer) { return run_forest(tree, {.computer = computer}); });
    CHECK(outcome_of(forest) == tree.outcome());
    const auto svm =
        on_ranks(ranks, 7, [&](const nodes::ComputerRequest& computer) { return run_svm(refined, {.computer = computer}); });
    CHECK(outcome_of(svm) == refined.outcome());
    const auto dataflow =
        on_ranks(ranks, 7, [&](const nodes::ComputerRequest& computer) { return run_dataflow(refined, {.computer = computer}); });
    CHECK(outcome_of(dataflow) == refined.outcome());
  }
}

TEST_CASE("fewer nodes than ranks are refused by every strategy's plan") {
  const Subject subject(tests::mirrors_and_glass(), {.width = 4, .height = 4});
  const auto refusals = [&](const auto& render) {
    return tests::on_ranks(4, {}, [&](nodes::Fabric& fabric) {
      nodes::RankLinks links(fabric);
      return render(nodes::ComputerRequest{.node_count = 3, .ranks = &links});
    });
  };
  const std::string sentence = "node_count=3: expected at least one node for each of the 4 ranks";
  for (const auto& result :
       refusals([&](const nodes::ComputerRequest& computer) { return run_svm(subject, {.computer = computer}); })) {
    CHECK(result.failure_text() == sentence);
  }
  for (const auto& result :
       refusals([&](const nodes::ComputerRequest& computer) { return run_dataflow(subject, {.computer = computer}); })) {
    CHECK(result.failure_text() == sentence);
  }
}

}  // namespace
