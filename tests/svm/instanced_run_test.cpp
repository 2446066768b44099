// Base meshes, by nodes whose pages travel, and by nodes that hold all.
#include <doctest/doctest.h>

#include <cstdint>
#include <optional>

#include "core/trace/charge.h"
#include "svm/run.h"
#include "tests/support/base_mesh_scenes.h"
#include "tests/support/priced_machine.h"
#include "tests/support/scaled.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::instanced_run_test {
namespace {

svm::RunOptions way_of(int number, std::uint64_t seed) {
  return {.computer = computer_of_kind(number, 3 + static_cast<std::uint32_t>(seed % 5), seed)};
}

}  // namespace

TEST_CASE("nodes show of what is kept once what its copies show: on threads, a pool, a model and in chaos, with a page, or all") {
  std::uint64_t seed = 0;
  for (const Arrangement arrangement : {Arrangement::apart, Arrangement::deep_in_each_other}) {
    const core::Scene scene = balls_in_places(0.3, arrangement, 21);
    const int side = scaled_edge(24);
    const Subject copies(scene, {side, side, 2}, with_copies()), kept(scene, {side, side, 2}, with_instances());
    REQUIRE(kept.database().records().instances > 0);
    for (int number = 0; number < 4; ++number) {
      for (const std::optional<std::uint32_t> cache : {std::optional<std::uint32_t>(1), std::optional<std::uint32_t>()}) {
        CAPTURE(number);
        CAPTURE(++seed);
        svm::RunOptions options = way_of(number, seed);
        options.pages.cache_pages = cache;
        CHECK(outcome_of(run_svm(kept, options)) == copies.outcome());
      }
      CHECK(outcome_of(run_replicated(kept, way_of(number, ++seed))) == copies.outcome());
    }
  }
}

TEST_CASE("a modelled node computes what its ways into base meshes and the triangles that it places cost, beside all else") {
  const core::Scene scene = balls_in_places(0.3, Arrangement::apart, 24);
  const Subject kept(scene, {16, 16}, with_instances());
  const nodes::Machine machine = priced_machine();
  const svm::Report report = run_svm(kept, {.computer = {.node_count = 1, .machine = machine}});
  const core::Operations done = report.operations();
  core::Operations of_copies = done;
  of_copies.instance_entries = of_copies.placed_triangles = 0;
  const auto price_ns = [&](const core::Operations& operations) {
    nodes::Charges charges{core::charges_of(operations)};
    charges[core::Charge::home_lookup] = report.pages().home_hits;
    return machine.price_ps(charges) / 1000;
  };
  const auto cost_ps = [&](core::Charge charge) { return machine.cost_ps[static_cast<std::size_t>(charge)]; };
  CHECK(report.virtual_time->nodes[0].computing_ns == price_ns(done));
  CHECK(price_ns(done) - price_ns(of_copies) ==
        doctest::Approx(
            1e-3 * static_cast<double>(done.instance_entries * core::bvh_nodes_an_entry * cost_ps(core::Charge::bvh_node_read) +
                                       done.placed_triangles * core::tests_a_placing * cost_ps(core::Charge::triangle_test)))
            .epsilon(1e-6)
            .scale(0));
  CHECK(done.instance_entries > 0);
}

TEST_CASE("a plan has the room for the longer cursors of a database with instances") {
  const core::Scene scene = balls_in_places(0.3, Arrangement::apart, 25);
  const Subject kept(scene, {16, 16}, with_instances());
  const svm::Report report = run_svm(kept, {.computer = {.node_count = 4}});
  for (const svm::NodeReport& node : report.nodes) {
    CHECK(node.memory_used.bytes == node.memory_planned.bytes);
  }
}

}  // namespace dmpc::tests::instanced_run_test
