// A scene pays for what it has: one triangle under one light leaves every counter at zero whose feature it does not use. For each
// of these counters there is a scene that uses it, so that the zeros mean something.
#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <string>

#include "tests/support/base_mesh_scenes.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::needless_scene_test {

namespace {

/// What a scene may do without, by name.
using Features = std::map<std::string, std::uint64_t>;

core::Scene one_triangle() {
  core::Scene scene;
  scene.name = "one triangle";
  scene.view = {.from = {0, -3, 1}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 40};
  scene.lights = {{{0.5, -2, 3}}};
  core::SceneBuilder builder(scene);
  builder.material({.color = {1, 0.5, 0.2}, .diffuse = 1});
  builder.polygon({{-1, 0, -0.5}, {1, 0, -0.5}, {0, 0.2, 0.8}});
  return scene;
}

/// Everything at once, a light that blinds and a polygon without an area.
core::Scene too_much() {
  core::Scene scene = everything();
  scene.lights.push_back({{-2, -4, 3}, {1e12, 1e12, 1e12}, true});
  core::SceneBuilder(scene).polygon({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}});
  return scene;
}

std::uint64_t beyond_one(std::uint64_t count) { return count > 1 ? count - 1 : 0; }

Features features_of(const core::Database& database) {
  const core::RecordCounts& records = database.records();
  const auto leaves = [&](core::PrimitiveKind kind) { return records.leaves[static_cast<std::size_t>(kind)]; };
  return {{"primitives dropped", database.dropped()},
          {"copies of primitives", database.references() - database.header().primitive_count},
          {"BVH nodes beyond one", beyond_one(records.bvh_nodes)},
          {"triangle blocks beyond one", beyond_one(leaves(core::PrimitiveKind::triangle))},
          {"sphere blocks", leaves(core::PrimitiveKind::sphere)},
          {"cone blocks", leaves(core::PrimitiveKind::cone)},
          {"normals", records.normals},
          {"textured triangles", records.textured},
          {"tiles of textures", records.texture_tiles},
          {"pages beyond one", beyond_one(database.page_count())}};
}

Features features_of(const core::Operations& operations) {
  const auto rays = [&](core::RayKind kind) { return operations.rays[static_cast<std::size_t>(kind)]; };
  const auto tests = [&](core::PrimitiveKind kind) { return operations.primitive_tests[static_cast<std::size_t>(kind)]; };
  return {{"reflected rays", rays(core::RayKind::reflected)},
          {"refracted rays", rays(core::RayKind::refracted)},
          {"secondary hits", operations.secondary_hits},
          {"shadow rays blocked", operations.shadow_blocked},
          {"total internal reflections", operations.total_internal_reflections},
          {"sphere tests", tests(core::PrimitiveKind::sphere)},
          {"cone tests", tests(core::PrimitiveKind::cone)},
          {"normals read", operations.normal_reads},
          {"textures looked up", operations.texture_lookups},
          {"tiles of textures read", operations.tile_reads},
          {"deposits saturated", operations.deposits_saturated},
          {"rays cut", operations.rays_cut},
          {"cells skipped", operations.empty_cells},
          {"children that waited", operations.skipped.any_hit},
          {"lights behind surfaces", operations.skipped.unlit}};
}

/// The skips of scenes with base meshes.
Features instancing_features_of(const core::Operations& operations) {
  return {{"ways into base meshes", operations.instance_entries}, {"triangles placed", operations.placed_triangles}};
}

/// Skips without effect also on several nodes.
Features features_of(const svm::Report& report) {
  Features features = features_of(report.operations());
  features["later passes"] = report.refinement.passes - 1;
  features["evictions"] = report.pages().evictions;
  return features;
}

/// Skips without effect on one node.
Features lonely_features_of(const svm::Report& report) {
  return {{"page faults", report.pages().faults},
          {"cached pages", report.pages().cache_hits},
          {"work asked for", report.work().items_asked},
          {"nodes passed over", report.operations().skipped.idle_nodes}};
}

Features features_of(const dataflow::Report& report) {
  Features features = features_of(report.operations());
  features["later passes"] = report.refinement.passes - 1;
  features["rays overflowed"] = report.gathers().rays_overflowed;
  features["rays kept by the host"] = report.host_rays.rays_in;
  features["packets queued"] = report.gathers().packets_queued;
  return features;
}

Features lonely_features_of(const dataflow::Report& report) {
  return {{"rays sent", report.gathers().rays}, {"regions passed by", report.operations().skipped.empty_regions}};
}

void check_zero(const Features& features) {
  for (const auto& [name, count] : features) {
    CAPTURE(name);
    CHECK(count == 0);
  }
}

void check_used(const Features& features) {
  for (const auto& [name, count] : features) {
    CAPTURE(name);
    CHECK(count > 0);
  }
}

}  // namespace

TEST_CASE("one triangle under one light does nothing that it does not need, on one node and on several") {
  const Subject subject(one_triangle(), {16, 16});
  REQUIRE(subject.outcome().primary_hits > 20);
  REQUIRE(subject.outcome().rays[static_cast<std::size_t>(core::RayKind::shadow)] == subject.outcome().primary_hits);
  CHECK(subject.outcome().rays[static_cast<std::size_t>(core::RayKind::scattered)] == 0);
  check_zero(features_of(subject.database()));
  for (const std::uint32_t nodes : {1U, 4U}) {
    CAPTURE(nodes);
    check_zero(features_of(run_svm(subject, {.computer = {.node_count = nodes}})));
    check_zero(features_of(run_replicated(subject, {.computer = {.node_count = nodes}})));
    check_zero(features_of(run_dataflow(subject, {.computer = {.node_count = nodes}})));
    check_zero(instancing_features_of(run_svm(subject, {.computer = {.node_count = nodes}}).operations()));
  }
}

TEST_CASE("one node alone asks nobody for one triangle, nor for anything else") {
  for (const core::Scene& scene : {one_triangle(), too_much()}) {
    const Subject subject(scene, {16, 16});
    check_zero(lonely_features_of(run_svm(subject, {.computer = {.node_count = 1}})));
    check_zero(lonely_features_of(run_replicated(subject, {.computer = {.node_count = 1}})));
    check_zero(lonely_features_of(run_dataflow(subject, {.computer = {.node_count = 1}})));
  }
}

TEST_CASE("what one triangle does not need other scenes do") {
  const Subject subject(
      too_much(), {.width = 24, .height = 20, .samples = 2, .refinement = {.error = 0.02, .samples_max = 8}, .cutoff = 0.001},
      {.page_size_bytes = 512, .cells_per_primitive = 4096});
  check_used(features_of(subject.database()));
  const svm::Report svm = run_svm(subject, {.computer = {.node_count = 5}, .pages = {.cache_pages = 2}});
  check_used(features_of(svm));
  check_used(lonely_features_of(svm));
  const dataflow::RunOptions starved{
      .computer = {.node_count = 24},
      .rays = {.balance = {.balance = dataflow::Balance::equal_size}, .ray_batch = 1, .ray_credits = 1, .queue_packets = 1}};
  const dataflow::Report dataflow = run_dataflow(subject, starved);
  check_used(features_of(dataflow));
  check_used(lonely_features_of(dataflow));
}

TEST_CASE("meshes that are kept take what their copies do not") {
  const core::Scene scene = balls_in_places(0.3, Arrangement::apart, 2);
  check_used(instancing_features_of(run_svm(Subject(scene, {16, 16}, with_instances()), {}).operations()));
  check_zero(instancing_features_of(run_svm(Subject(scene, {16, 16}, with_copies()), {}).operations()));
}

}  // namespace dmpc::tests::needless_scene_test
