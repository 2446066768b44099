// Base meshes, by nodes among which rays travel.
#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/refusal.h"
#include "dataflow/frames.h"
#include "dataflow/ranks.h"
#include "dataflow/run.h"
#include "nodes/ranks/rank_links.h"
#include "tests/support/base_mesh_scenes.h"
#include "tests/support/loopback_ranks.h"
#include "tests/support/scaled.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::dataflow_instanced_run_test {
namespace {

using dataflow::Balance;
using dataflow::Report;
using dataflow::RunOptions;

RunOptions way_of(int number, std::uint32_t nodes, std::uint64_t seed) {
  RunOptions options{.computer = computer_of_kind(number, nodes, seed)};
  options.rays.balance = {.balance = seed % 2 == 0 ? Balance::subsampled : Balance::equal_size, .subsample = 4};
  return options;
}

}  // namespace

TEST_CASE(
    "rays that travel show of what is kept once what its copies show: on threads, a pool, a model, in chaos, on 1 to 64 nodes") {
  std::uint64_t seed = 0;
  for (const Arrangement arrangement : {Arrangement::apart, Arrangement::deep_in_each_other, Arrangement::coincident}) {
    for (const double size : {0.5, 0.02}) {
      const core::Scene scene = balls_in_places(size, arrangement, 31 + seed);
      const int side = scaled_edge(24);
      const Subject copies(scene, {side, side, 2}, with_copies()), kept(scene, {side, side, 2}, with_instances());
      REQUIRE(kept.database().records().instances > 0);
      REQUIRE(kept.outcome() == copies.outcome());
      for (const std::uint32_t nodes : {1U, 2U, 8U, 27U, 64U}) {
        const int number = static_cast<int>(++seed % 4);
        CAPTURE(seed);
        CAPTURE(nodes);
        CHECK(outcome_of(run_dataflow(kept, way_of(number, nodes, seed))) == copies.outcome());
      }
    }
  }
}

TEST_CASE("a mesh that spans all regions, and places that each span several, show what copies show, mirrored and turned") {
  core::Scene mesh = rug_on_floor(true, true, 6);
  std::vector<core::Transform> places;
  for (int i = 0; i < 9; ++i) {
    places.push_back(turned_place(i == 0 ? 1.0 : 0.3,
                                  core::Vec3d{0.3 * (i % 3), 0.4 * (i / 3), 0.2 * i} - core::Vec3d{0.3, 0.4, 0}, i % 2 == 1));
  }
  const core::Scene scene = placed(mesh, places);
  const int side = scaled_edge(32);
  const Subject copies(scene, {side, side}, with_copies()), kept(scene, {side, side}, with_instances());
  REQUIRE(kept.database().records().instances == 9);
  for (const std::uint32_t nodes : {3U, 16U}) {
    for (int number = 0; number < 4; ++number) {
      CHECK(outcome_of(run_dataflow(kept, way_of(number, nodes, static_cast<std::uint64_t>(number)))) == copies.outcome());
    }
  }
}

TEST_CASE("scattered and moving regions show of what is kept what its copies show") {
  const core::Scene scene = balls_in_places(0.4, Arrangement::deep_in_each_other, 23);
  const int side = scaled_edge(32);
  const Subject copies(scene, {side, side, 2}, with_copies(512)), kept(scene, {side, side, 2}, with_instances(512));
  for (const Balance balance : {Balance::scattered, Balance::moving}) {
    for (const std::uint32_t regions : {2U, 9U}) {
      for (const bool bundles : {true, false}) {
        CAPTURE(regions);
        CAPTURE(bundles);
        RunOptions options{.computer = {.node_count = 5}};
        options.rays.balance = {.balance = balance, .subsample = 4, .regions_a_node = regions};
        CHECK(outcome_of(run_dataflow(kept, options, {.bundles = bundles})) == copies.outcome());
        options.computer.machine = nodes::Machine{};
        CHECK(outcome_of(run_dataflow(kept, options)) == copies.outcome());
      }
    }
  }
}

TEST_CASE("units are migrated with the meshes of the places in them") {
  const core::Scene scene = balls_in_places(0.25, Arrangement::deep_in_each_other, 29);
  const Subject kept(scene, {64, 64}, with_instances(512));
  RunOptions options{.computer = {.node_count = 6}};
  options.computer.machine = nodes::Machine{};
  options.rays.balance = {.balance = Balance::moving, .subsample = 32, .regions_a_node = 12};
  const Report report = run_dataflow(kept, options);
  CHECK(outcome_of(report) == kept.outcome());
  std::uint64_t taken = 0;
  for (const dataflow::NodeReport& node : report.nodes) {
    taken += node.program.movement.units_taken;
  }
  CHECK(taken > 0);
}

TEST_CASE(
    "rays that walk alone and in bundles, and with every region asked, show the same of what is kept, and but for shadow rays go "
    "the same ways") {
  const core::Scene scene = balls_in_places(0.3, Arrangement::deep_in_each_other, 33);
  const int side = scaled_edge(24);
  const Subject copies(scene, {side, side, 3}, with_copies(512)), kept(scene, {side, side, 3}, with_instances(512));
  std::optional<std::array<std::uint64_t, core::ray_kind_count>> hops;
  for (const bool bundles : {false, true}) {
    RunOptions options{.computer = {.node_count = 4}};
    options.rays.balance.balance = Balance::equal_size;
    const Report report = run_dataflow(kept, options, {.bundles = bundles});
    CHECK(outcome_of(report) == copies.outcome());
    CHECK((report.operations().bundles > 0) == bundles);
    auto out = report.rays().out;
    out[static_cast<std::size_t>(core::RayKind::shadow)] = 0;  // any hit will do, and bundles look at more boxes of a mesh
    CHECK(out == hops.value_or(out));
    hops = out;
    CHECK(outcome_of(run_dataflow(kept, options, {.empty_regions = false, .bundles = bundles})) == copies.outcome());
  }
}

TEST_CASE("refined pictures and pictures by paths of what is kept are those of its copies") {
  const core::Scene scene = balls_in_places(0.3, Arrangement::apart, 8);
  const int side = scaled_edge(24);
  Subject::Size picture{side, side, 2, {.error = 0.01, .samples_max = 64}};
  const Subject copies(scene, picture, with_copies()), kept(scene, picture, with_instances());
  CHECK(outcome_of(run_dataflow(kept, {.computer = {.node_count = 8}})) == copies.outcome());
  picture = {.width = side, .height = side, .samples = 2, .transport = {.kind = core::TransportKind::paths, .has_sky = true}};
  core::BuildOptions with_paths = with_instances();
  with_paths.for_paths = true;
  with_paths.emitters_max = 16;
  const Subject by_paths(scene, picture, with_paths);
  CHECK(outcome_of(run_dataflow(by_paths, {.computer = {.node_count = 8}})) == by_paths.outcome());
}

TEST_CASE("frames of what is kept, and runs of it on several ranks, have the film of one run") {
  const core::Scene scene = balls_in_places(0.3, Arrangement::apart, 13);
  const int side = scaled_edge(24);
  const Subject kept(scene, {side, side}, with_instances());
  RunOptions options{.computer = {.node_count = 5}, .are_frames = true};
  const dataflow::Prepared prepared = dataflow::prepare(kept.database(), kept.settings(), options);
  dataflow::Frames frames(prepared, kept.settings(), options, {});
  CHECK(frames.render({}).film.hash() == kept.outcome().film_hash);
  CHECK(frames.render(kept.settings(), {}, {}).film.hash() == kept.outcome().film_hash);

  const auto ranks = on_ranks(3, {}, [&](nodes::Fabric& fabric) {
    nodes::RankLinks links(fabric);
    if (fabric.rank() == 0) {
      return outcome_of(run_dataflow(kept, {.computer = {.node_count = 7, .ranks = &links}})).film_hash;
    }
    dataflow::follow(links, {});
    return kept.outcome().film_hash;
  });
  for (const auto& rank : ranks) {
    CHECK(rank.failure_text() == "");
    CHECK(rank.value == kept.outcome().film_hash);
  }
}

TEST_CASE("a plan has the room for the longer cursors and bundles of a database with instances, and no node takes more") {
  const core::Scene scene = balls_in_places(0.3, Arrangement::apart, 25);
  const Subject kept(scene, {16, 16}, with_instances());
  for (const bool bundles : {true, false}) {
    const Report report = run_dataflow(kept, {.computer = {.node_count = 4}}, {.bundles = bundles});
    for (std::uint32_t i = 0; i < 4; ++i) {
      CHECK(report.nodes[i].memory_used.bytes == report.plan.node_memory(i).bytes);
    }
    CHECK(report.plan.rays_a_task == (bundles ? 16 : 1));
  }
}

TEST_CASE("a list of tested objects does not go with what is kept: a plan that asks for both is refused, with why") {
  const core::Scene scene = balls_in_places(0.3, Arrangement::apart, 27);
  const Subject kept(scene, {8, 8}, with_instances());
  CHECK_THROWS_WITH_AS(run_dataflow(kept, {.computer = {.node_count = 2}, .rays = {.tested_objects = 2}}),
                       doctest::Contains("occurs in many instances"), core::Refusal<core::UsageError>);
}

}  // namespace dmpc::tests::dataflow_instanced_run_test
