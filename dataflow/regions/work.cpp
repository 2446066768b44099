#include "dataflow/regions/work.h"

namespace dmpc::dataflow {

// How they were measured: 12 scenes (balls, gears, jacks, mount, rings, shells, teapot, tetra, tree; balls, rings and tree also
// as triangles) at 512x512, every other pixel; the time of each 32x32 tile on one thread's own clock (least of 9 runs) against
// its counted operations; non-negative least squares of the relative errors over the 3,072 tiles. Half of the tiles are met to
// 10 %, nine in ten to 23 %; the worst scene is balls-4-t4, whose records exceed the caches (63 % of its time). Only their
// ratios matter here. The price of a tile is that of a million look-ups in a texture of 512x512 texels, 2.5 tiles each.
const WorkPrices measured_prices{.ray_ps = 55'000,
                                 .cell_step_ps = 7'500,
                                 .brick_read_ps = 14'700,
                                 .primitive_test_ps = {3'700, 7'200, 19'800},
                                 .shading_ps = 167'000,
                                 .tile_read_ps = 67'000};

std::uint64_t work_of(const core::Operations& operations, const WorkPrices& prices) {
  std::uint64_t sum = operations.traced_ray_count() * prices.ray_ps;
  for (std::size_t kind = 0; kind < core::primitive_kind_count; ++kind) {
    sum += operations.primitive_tests[kind] * prices.primitive_test_ps[kind];
  }
  return sum + operations.cell_steps * prices.cell_step_ps + operations.brick_reads * prices.brick_read_ps +
         operations.shadings * prices.shading_ps + operations.tile_reads * prices.tile_read_ps;
}

}  // namespace dmpc::dataflow
