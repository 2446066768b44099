// The node program of dataflow allocates nothing between start and end. This executable has the replaced global operators.
#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "core/families/scenes.h"
#include "dataflow/run.h"
#include "nodes/threads/threads_runner.h"
#include "tests/support/allocation_guard.h"

namespace dmpc::tests::dataflow_program_allocation_test {

namespace {

/// Renders a small scene with every node under watch, but not the host, whose memory for rays that overflow grows; returns what
/// they allocated and freed.
std::uint64_t allocated_by(const dataflow::PlanRequest& bounds, std::uint32_t node_count) {
  const core::Scene scene = core::built_in_scene(core::parse_scene_name("balls-2"));
  const core::Database database = core::build_database(scene, {});
  const core::RenderSettings settings{
      database.header(), core::Camera(scene.view, database.header().frame, 16, 16, 2), {}, bounds.refinement};
  const dataflow::Distribution distribution = dataflow::distribute(
      database, settings, dataflow::share_out(dataflow::column_loads(database, settings, {}), node_count, {}).regions);
  dataflow::PlanRequest request = bounds;
  request.shares = distribution.shares();
  request.width = request.height = 16;
  request.first_samples = 2;
  const dataflow::Plan plan = dataflow::make_plan(request);
  core::Film film(16, 16);
  const dataflow::RunOptions options;
  std::vector<nodes::NodeSpecification> specifications = dataflow::specifications_of(plan, distribution, settings, film, options);
  for (std::uint32_t i = 0; i < node_count; ++i) {
    specifications[i] = watched(specifications[i]);
  }
  nodes::ThreadsRunner runner(specifications);
  return allocated_in_run(runner);
}

TEST_CASE("a node of dataflow allocates nothing while it traces, receives and sends") {
  CHECK(allocated_by({}, 5) == 0);
  CHECK(allocated_by({.rays = {.ray_batch = 1, .ray_credits = 1}}, 5) == 0);
  CHECK(allocated_by({.rays = {.ray_credits = 0}}, 3) == 0);
  CHECK(allocated_by({.rays = {.ray_batch = 1, .ray_slots = 1}}, 5) == 0);
  CHECK(allocated_by({.refinement = {.error = 0.01}}, 3) == 0);
  CHECK(allocated_by({.bundles = true}, 5) == 0);
  CHECK(allocated_by({.rays = {.ray_batch = 1, .ray_credits = 0}, .bundles = true}, 3) == 0);
}

}  // namespace
}  // namespace dmpc::tests::dataflow_program_allocation_test
