#include "core/trace/work.h"

#include <doctest/doctest.h>

namespace dmpc::tests::trace_work_test {

TEST_CASE("no operation is no work") { CHECK(core::work_of({}) == 0); }

TEST_CASE("work is each operation at its price") {
  core::Operations operations;
  operations.rays = {1, 2, 3, 4};
  operations.cell_steps = 5;
  operations.bvh_node_reads = 6;
  operations.primitive_tests = {7, 8, 9};
  operations.shadings = 10;
  operations.tile_reads = 11;
  const core::WorkPrices prices{10'000'000, 1'000'000, 100'000, {10'000, 1'000, 100}, 10, 1};
  CHECK(core::work_of(operations, prices) == 100'000'000 + 5'000'000 + 600'000 + 70'000 + 8'000 + 900 + 100 + 11);
}

TEST_CASE("to go into a base mesh is work of BVH nodes, and to place its triangles work of tests, as machines are charged") {
  core::Operations operations;
  operations.instance_entries = 3;
  operations.placed_triangles = 40;
  const core::WorkPrices prices{.bvh_node_read_ps = 1'000'000, .primitive_test_ps = {1000, 1, 1}};
  CHECK(core::work_of(operations, prices) == 3 * core::bvh_nodes_an_entry * 1'000'000 + 40 * core::tests_a_placing * 1000);
}

TEST_CASE("a ray that is known to meet only the background is no work") {
  core::Operations operations;
  operations.rays = {5, 0, 0, 0};
  operations.skipped.background = 3;
  CHECK(core::work_of(operations, {.ray_ps = 7}) == 2 * 7);
}

TEST_CASE("every kind of work has a price") {
  const core::WorkPrices& prices = core::measured_prices;
  CHECK(prices.ray_ps > 0);
  CHECK(prices.cell_step_ps > 0);
  CHECK(prices.bvh_node_read_ps > 0);
  CHECK(prices.shading_ps > 0);
  CHECK(prices.tile_read_ps > 0);
  for (const std::uint64_t price : prices.primitive_test_ps) {
    CHECK(price > 0);
  }
}

}  // namespace dmpc::tests::trace_work_test
