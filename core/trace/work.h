// A node's work as one number: counted operations, each with its price. Decides how space is shared out, never the picture.
#pragma once

#include <array>
#include <cstdint>

#include "core/trace/operations.h"

namespace dmpc::core {

/// The price of one operation of each kind, in picoseconds.
struct WorkPrices {
  std::uint64_t ray_ps = 0;  ///< making a ray and beginning its traversal
  std::uint64_t cell_step_ps = 0;
  std::uint64_t bvh_node_read_ps = 0;
  std::array<std::uint64_t, primitive_kind_count> primitive_test_ps{};  ///< per lane
  std::uint64_t shading_ps = 0;                                         ///< a hit: geometry, normals, material
  std::uint64_t tile_read_ps = 0;                                       ///< a tile of a texture, with its entry in the table
};

/// Prices of one core of the machine on which they were measured: 12 scenes (balls, gears, jacks, mount, rings, shells, teapot,
/// tetra, tree; balls, rings and tree also as triangles) at 512x512, every other pixel; the time of each 32x32 tile on the
/// thread's own clock (least of 9 runs) against its counted operations; non-negative least squares of the relative errors over
/// the 3,072 tiles. Half of the tiles are predicted to 10 %, nine in ten to 23 %; the worst scene is balls-4-t4, whose records
/// exceed the caches (63 % of its time). Only the prices' ratios matter here. The price of a tile is from a million look-ups in a
/// texture of 512x512 texels, 2.5 tiles each.
inline constexpr WorkPrices measured_prices{.ray_ps = 55'000,
                                            .cell_step_ps = 7'500,
                                            .bvh_node_read_ps = 14'700,
                                            .primitive_test_ps = {3'700, 7'200, 19'800},
                                            .shading_ps = 167'000,
                                            .tile_read_ps = 67'000};

/// Work for base meshes is priced by similar work: a ray's entry into a mesh as this many BVH nodes, which are boxes and
/// transforms of a ray, and placing a triangle as this many tests, as both are products and sums of its corners. Measured: 105 ns
/// and 18 to 20 ns of that core, in 9 scenes (teapot, mount, gears and tetra in 12 to 500 instances, apart and deep in each
/// other) at 256x256, every other pixel, single rays; the time of each 32x32 tile (least of 9 runs, by the scale that the same
/// scenes have with copies) less that of its other operations; least squares of the relative errors over 514 tiles, of which half
/// are predicted to 9 % and nine in ten to 20 %.
inline constexpr std::uint64_t bvh_nodes_an_entry = 7, tests_a_placing = 5;

/// The work of these operations, in picoseconds. Thread safety: pure.
std::uint64_t work_of(const Operations& operations, const WorkPrices& prices = measured_prices);

}  // namespace dmpc::core
