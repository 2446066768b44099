// Units that are migrated while rays travel: whoever has them by then, the film stays.
#include "dataflow/units/movement.h"
#include "core/trace/charge.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <numeric>

#include "dataflow/run.h"
#include "nodes/chaos.h"
#include "tests/support/small_scenes.h"
#include "tests/support/subject.h"

namespace dmpc::tests::movement_test {
namespace {

const Subject& crowded() {
  static const Subject subject(built_in("gears-2"), {48, 48});
  return subject;
}

dataflow::RunOptions moving(std::uint32_t node_count, std::uint32_t units_a_node) {
  dataflow::RunOptions options{.computer = {.node_count = node_count}};
  options.rays.balance = {.balance = dataflow::Balance::moving, .regions_a_node = units_a_node};
  return options;
}

dataflow::RunOptions modelled(std::uint32_t node_count, std::uint32_t units_a_node) {
  dataflow::RunOptions options = moving(node_count, units_a_node);
  options.computer.machine = nodes::Machine{};
  return options;
}

/// Runs and holds film, rays and hits to the reference renderer's.
dataflow::Report render(const dataflow::RunOptions& options) {
  dataflow::Report report = dataflow::run_dataflow(crowded().database(), crowded().settings(), options, {});
  CHECK(outcome_of(report) == crowded().outcome());
  return report;
}

}  // namespace

TEST_CASE("one node with several units has nobody to hand them to") {
  const dataflow::MovementCounters movement = render(moving(1, 4)).movement();
  CHECK(movement.units == 4);
  CHECK(movement.asks == 0);
  CHECK(movement.units_given == 0);
}

TEST_CASE("regions that do not move count nothing of units") {
  dataflow::RunOptions options{.computer = {.node_count = 4, .machine = nodes::Machine{}}};
  const dataflow::MovementCounters movement = render(options).movement();
  CHECK(movement.units == 0);
  CHECK(movement.asks == 0);
}

TEST_CASE("units are migrated with primary rays on a modelled machine of every wiring, and the film stays") {
  for (const auto kind : {nodes::TopologyKind::hypercube, nodes::TopologyKind::mesh, nodes::TopologyKind::torus,
                          nodes::TopologyKind::fat_tree, nodes::TopologyKind::crossbar}) {
    dataflow::RunOptions options = modelled(8, 8);
    options.rays.topology = kind;
    const dataflow::MovementCounters movement = render(options).movement();
    CHECK(movement.units == 64);
    CHECK(movement.units_given > 0);
    CHECK(movement.units_given == movement.units_taken);
    CHECK(movement.primaries_given > 0);
    CHECK(movement.primaries_given == movement.primaries_taken);
    CHECK(movement.pages_sent > movement.units_given);
    CHECK(movement.asks == movement.refusals + movement.units_taken);
  }
}

TEST_CASE("units that move take the same way in two runs of a modelled machine") {
  const dataflow::Report first = render(modelled(8, 8)), second = render(modelled(8, 8));
  REQUIRE(first.virtual_time);
  CHECK(first.virtual_time->run_hash(first.film.hash()) == second.virtual_time->run_hash(second.film.hash()));
}

TEST_CASE("a node without a free frame or without room for primary rays takes no unit, and the film stays") {
  dataflow::RunOptions options = modelled(8, 8);
  const dataflow::Prepared prepared = dataflow::prepare(crowded().database(), crowded().settings(), options);
  CHECK(prepared.plan.spare_frames > 0);
  const std::size_t least = dataflow::smallest_node_memory_bytes(prepared.plan.request);
  options.computer.node_memory_bytes = least;
  const dataflow::Report starved = render(options);
  CHECK(starved.plan.spare_frames == 0);
  const std::uint32_t largest = starved.plan.largest_node();
  CHECK(starved.nodes[largest].program.movement.units_taken == 0);
  CHECK(starved.nodes[largest].program.movement.asks == 0);
  for (const dataflow::NodeReport& node : starved.nodes) {
    CHECK(node.memory_used.total() <= least);
  }
  options.computer.node_memory_bytes = least - 1;
  CHECK_THROWS_AS(dataflow::run_dataflow(crowded().database(), crowded().settings(), options, {}), core::CapacityError);
}

TEST_CASE("where the host assigns the primary rays units stay where they are, and the film stays") {
  dataflow::RunOptions options = modelled(8, 8);
  options.continuation.keep = [](const core::Film&, const core::Refinement&, const core::PixelMask&) {};
  options.continuation.is_due = [] { return false; };
  const dataflow::MovementCounters movement = render(options).movement();
  CHECK(movement.units == 64);
  CHECK(movement.units_given == 0);
}

TEST_CASE("units are migrated on disturbed computers, and the film stays") {
  std::uint64_t given = 0, sent_on = 0;
  for (std::uint64_t seed = 1; seed <= 40 || (sent_on == 0 && seed <= 2000); ++seed) {  // threads' order is not repeatable
    INFO("seed ", seed);
    dataflow::RunOptions options = moving(static_cast<std::uint32_t>(2 + seed % 7), 6);
    options.computer.chaos = nodes::Chaos{.seed = seed};
    const dataflow::MovementCounters movement = render(options).movement();
    given += movement.units_given;
    sent_on += movement.rays_sent_on;
  }
  CHECK(given > 0);
  CHECK(sent_on > 0);
}

TEST_CASE("units move where packets have one ray and nodes one credit, or one place that they share") {
  for (const bool are_shared : {false, true}) {
    dataflow::RunOptions options = modelled(8, 8);
    options.rays.ray_batch = 1;
    (are_shared ? options.rays.ray_slots : options.rays.ray_credits) = 1;
    CHECK(render(options).movement().units_given > 0);
  }
}

TEST_CASE("where all rays go by way of the host nobody hears who has primary rays, and units stay where they are") {
  dataflow::RunOptions options = modelled(8, 8);
  options.rays.ray_credits = 0;
  const dataflow::MovementCounters movement = render(options).movement();
  CHECK(movement.units == 64);
  CHECK(movement.asks == 0);
}

TEST_CASE("a modelled machine takes its time for units' pages, and for the records read to find them") {
  const auto computing_ns_with = [](core::Charge charge, dataflow::MovementCounters& movement) {
    dataflow::RunOptions options = modelled(8, 8);
    options.computer.machine->cost_ps[static_cast<std::size_t>(charge)] = 1'000'000;
    const dataflow::Report report = render(options);
    movement = report.movement();
    REQUIRE(report.virtual_time);
    return std::accumulate(report.virtual_time->nodes.begin(), report.virtual_time->nodes.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const nodes::VirtualTimes& node) { return sum + node.computing_ns; });
  };
  dataflow::MovementCounters movement;
  const std::uint64_t installing_ns = computing_ns_with(core::Charge::page_install, movement);
  CHECK(installing_ns == 1000 * movement.pages_installed);
  CHECK(movement.pages_installed > 0);
  CHECK(movement.pages_installed <= movement.pages_sent);
  const std::uint64_t reading_ns = computing_ns_with(core::Charge::bvh_node_read, movement);
  CHECK(reading_ns > 1000 * movement.records_walked);
  CHECK(movement.records_walked >= movement.pages_sent);
}

}  // namespace dmpc::tests::movement_test
