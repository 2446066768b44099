#include "core/trace/work.h"

namespace dmpc::core {

std::uint64_t work_of(const Operations& operations, const WorkPrices& prices) {
  std::uint64_t sum = operations.traced_ray_count() * prices.ray_ps;
  sum += operations.instance_entries * bvh_nodes_an_entry * prices.bvh_node_read_ps +
         operations.placed_triangles * tests_a_placing * prices.primitive_test_ps[0];
  for (std::size_t kind = 0; kind < primitive_kind_count; ++kind) {
    sum += operations.primitive_tests[kind] * prices.primitive_test_ps[kind];
  }
  return sum + operations.cell_steps * prices.cell_step_ps + operations.bvh_node_reads * prices.bvh_node_read_ps +
         operations.shadings * prices.shading_ps + operations.tile_reads * prices.tile_read_ps;
}

}  // namespace dmpc::core
