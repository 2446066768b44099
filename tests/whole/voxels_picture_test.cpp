// The picture of a plain grid of voxels: that of the other structures to the last bit, whoever renders it, and the same events
// again and again.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/trace/charge.h"
#include "dataflow/run.h"
#include "svm/run.h"
#include "tests/support/covering_faces.h"
#include "tests/support/film_of.h"
#include "tests/support/mesh_surfaces.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace voxels_picture_test {

namespace {

using namespace dmpc;
using core::Structure;
using tests::outcome_of;
using tests::Subject;

constexpr const char* families[] = {"balls-2",  "gears-1",    "jacks-1",  "lattice-2", "mount-3", "rings-2-t1",
                                    "shells-2", "sombrero-1", "teapot-4", "tetra-3",   "tree-3"};

core::BuildOptions voxels_by(const core::VoxelRule& rule, std::size_t page_size_bytes = 512) {
  return {.page_size_bytes = page_size_bytes, .structure = Structure::voxels, .voxels = rule};
}

/// One voxel for all, so that there is nothing but a list.
constexpr core::VoxelRule one_voxel{.voxels_max = 1};
/// More voxels than primitives by far.
constexpr core::VoxelRule many_voxels{.voxels_per_primitive = 200, .voxels_max = 40 * 40 * 40};

/// By every strategy that has pages or regions.
void check_strategies(const Subject& subject, std::uint32_t nodes) {
  CAPTURE(nodes);
  CHECK(outcome_of(run_svm(subject, {.computer = {.node_count = nodes}})) == subject.outcome());
  CHECK(outcome_of(run_svm(subject, {.computer = {.node_count = nodes}, .pages = {.cache_pages = 1}})) == subject.outcome());
  CHECK(outcome_of(run_replicated(subject, {.computer = {.node_count = nodes}})) == subject.outcome());
  for (const dataflow::Balance balance :
       {dataflow::Balance::subsampled, dataflow::Balance::equal_size, dataflow::Balance::scattered, dataflow::Balance::moving}) {
    CAPTURE(static_cast<int>(balance));
    const std::uint32_t regions = balance == dataflow::Balance::scattered || balance == dataflow::Balance::moving ? 4 : 1;
    const dataflow::BalanceOptions options{.balance = balance, .regions_a_node = regions};
    CHECK(outcome_of(run_dataflow(subject, {.computer = {.node_count = nodes}, .rays = {.balance = options}})) ==
          subject.outcome());
    const dataflow::RunOptions alone{.computer = {.node_count = nodes},
                                     .rays = {.balance = options, .ray_batch = 1, .tested_objects = 4}};
    CHECK(outcome_of(run_dataflow(subject, alone)) == subject.outcome());
  }
}

core::Operations reference(const Subject& subject, const core::Skips& skips) {
  core::Operations operations;
  tests::film_of(subject.database(), subject.settings(skips), operations);
  return operations;
}

}  // namespace

TEST_CASE("voxels give the film of the grid and of the extents, of every family and by every rule") {
  for (const char* name : families) {
    CAPTURE(name);
    const core::Scene scene = tests::built_in(name);
    const Subject::Size size{.width = 24, .height = 20, .samples = 2, .knows_background = true};
    const Subject grid(scene, size);
    CHECK(Subject(scene, size, {.structure = Structure::extents}).outcome() == grid.outcome());
    for (const core::VoxelRule& rule : {core::usual_voxels, core::article_voxels, one_voxel, many_voxels}) {
      CAPTURE(rule.voxels_per_primitive);
      CHECK(Subject(scene, size, voxels_by(rule, 1024)).outcome() == grid.outcome());
    }
  }
}

TEST_CASE("voxels give the film of the grid of textures, covering faces, glass and records in any order, on 1 to 16 nodes") {
  for (const core::Scene& scene : {tests::mirrors_and_glass(), tests::mesh_surfaces(), tests::glass_on_floor(true, true)}) {
    CAPTURE(scene.name);
    const Subject::Size size{.width = 20, .height = 16, .samples = 2};
    const Subject grid(scene, size);
    for (const core::VoxelRule& rule : {core::article_voxels, many_voxels}) {
      core::BuildOptions options = voxels_by(rule, 1024);
      options.record_order = core::RecordOrder::scattered;
      CHECK(Subject(scene, size, options).outcome() == grid.outcome());
      options.record_order = core::RecordOrder::spatial;
      const Subject voxels(scene, size, options);
      CHECK(voxels.outcome() == grid.outcome());
      for (const std::uint32_t nodes : {1U, 3U, 16U}) {
        check_strategies(voxels, nodes);
      }
    }
  }
}

TEST_CASE("voxels give the film of the grid where the eye is far away") {
  for (const char* name : {"teapot-4", "balls-3"}) {
    core::Scene scene = tests::built_in(name);
    scene.view.from = scene.view.at + (scene.view.from - scene.view.at) * 20.0;
    scene.view.angle_degrees /= 20;
    const Subject::Size size{.width = 20, .height = 16, .samples = 2};
    CHECK(Subject(scene, size, voxels_by(core::usual_voxels)).outcome() == Subject(scene, size).outcome());
  }
}

TEST_CASE("runs of empty voxels are left in one step, which counts what it avoids and changes nothing else") {
  const Subject subject(tests::built_in("balls-2"), {16, 12}, voxels_by(many_voxels));
  core::VoxelRule rule = many_voxels;
  rule.measures_empty_space = false;
  const Subject plain(tests::built_in("balls-2"), {16, 12}, voxels_by(rule));
  const core::Operations with = reference(subject, {.bundles = false}), without = reference(plain, {.bundles = false});
  CHECK(with.empty_cells > 0);
  CHECK(without.empty_cells == 0);
  CHECK(with.cell_steps < without.cell_steps);
  CHECK(with.cell_steps + with.empty_cells <= without.cell_steps);
  CHECK(with.primitive_tests == without.primitive_tests);
  CHECK(with.bvh_node_reads == 0);
  CHECK(plain.outcome() == subject.outcome());
}

TEST_CASE("rays pass by the owners of regions without lists, whether the outline has voxels or cubes of many") {
  for (const core::VoxelRule& rule : {core::usual_voxels, many_voxels}) {
    const Subject subject(tests::built_in("balls-2"), {16, 12}, voxels_by(rule));
    const auto run = [&](const core::Skips& skips) {
      return run_dataflow(
          subject, {.computer = {.node_count = 24}, .rays = {.balance = {.balance = dataflow::Balance::equal_size}}}, skips);
    };
    const dataflow::Report with = run({}), without = run({.empty_regions = false});
    CHECK(outcome_of(with) == subject.outcome());
    CHECK(outcome_of(without) == subject.outcome());
    CHECK(with.operations().skipped.empty_regions > 0);
    CHECK(with.gathers().rays < without.gathers().rays);
  }
}

TEST_CASE("rays that remember what they have tested test less where they walk on") {
  const Subject subject(tests::built_in("tetra-3"), {16, 12}, voxels_by(core::usual_voxels));
  const auto run = [&](std::uint32_t names) {
    return run_dataflow(subject, {.computer = {.node_count = 4}, .rays = {.tested_objects = names}});
  };
  const dataflow::Report with = run(8), none = run(0);
  CHECK(outcome_of(with) == outcome_of(none));
  std::uint64_t avoided = 0;
  for (const dataflow::NodeReport& node : with.nodes) {
    avoided += node.program.rays.tests_avoided;
  }
  CHECK(avoided > 0);
  CHECK(with.operations().primitive_tests[0] < reference(subject, {.bundles = false}).primitive_tests[0]);
}

TEST_CASE("a candidate's block that a ray meets again in another voxel is on no list, so no hit more is sent back") {
  for (const char* name : {"tetra-3", "rings-2-t1", "mount-3"}) {
    CAPTURE(name);
    const Subject subject(tests::built_in(name), {16, 12}, voxels_by(many_voxels));
    const auto sent_back = [&](std::uint32_t names) {
      const dataflow::RayOptions rays{.balance = {.balance = dataflow::Balance::equal_size}, .tested_objects = names};
      return run_dataflow(subject, {.computer = {.node_count = 8}, .rays = rays}).rays().hits_sent_back;
    };
    CHECK(sent_back(8) == sent_back(0));
  }
}

TEST_CASE("virtual time: voxels give the same events again, of which these are") {
  const Subject subject(tests::mirrors_and_glass(), {20, 16}, voxels_by(core::article_voxels, 1024));
  nodes::Machine machine{.name = "slow", .topology = nodes::TopologyKind::hypercube};
  machine.short_message = {.send_ns = 160'000, .latency_ns = 50'000, .receive_ns = 160'000, .byte_ps = 200'000};
  machine.long_message = {.send_ns = 160'000, .latency_ns = 430'000, .receive_ns = 160'000, .byte_ps = 353'000};
  for (std::size_t i = 0; i < machine.cost_ps.size(); ++i) {
    machine.cost_ps[i] = 1'000'000 + 100'001 * i;
  }
  const auto hash_of = [](const auto& report) { return report.virtual_time->hash; };
  const nodes::ComputerRequest computer{.node_count = 5, .machine = machine};
  const auto svm = run_svm(subject, {.computer = computer, .pages = {.cache_pages = 3}});
  const auto rays = run_dataflow(subject, {.computer = computer});
  CHECK(outcome_of(svm) == subject.outcome());
  CHECK(outcome_of(rays) == subject.outcome());
  CHECK(hash_of(svm) == hash_of(run_svm(subject, {.computer = computer, .pages = {.cache_pages = 3}})));
  CHECK(hash_of(svm) == 3043385434960497381U);
  CHECK(hash_of(rays) == 404212690122811648U);
}

}  // namespace voxels_picture_test
