// Classes of charged operations: those of ray tracing, and those of strategies, which bring rays and pages together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/trace/operations.h"
#include "core/trace/work.h"

namespace dmpc::core {

/// Classes of operations, for each of which a machine model has a price.
enum class Charge : std::uint8_t {
  ray_setup,      ///< a ray made and its traversal begun
  cell_step,      ///< a step of the traversal through the grid
  bvh_node_read,  ///< a record of the grid read; entering a base mesh counts as bvh_nodes_an_entry
  triangle_test,  ///< a primitive of a leaf tested with a ray; placing a triangle of a base mesh counts as tests_a_placing
  sphere_test,
  cone_test,
  shading,        ///< a hit shaded: geometry, normals, material, lights
  home_lookup,    ///< a record looked up in a page that is at home
  cached_lookup,  ///< a record looked up in a page of another home
  page_install,   ///< a page that arrived put into a frame
  ray_packing,    ///< a ray put into a packet or taken out of one
  tile_read,      ///< a tile of a texture found and read
  question_setup  ///< a traversal suspended for a question about a ray, or resumed where it is answered
};
inline constexpr std::array<std::string_view, 13> charge_names = {
    "ray_setup",   "cell_step",     "bvh_node_read", "triangle_test", "sphere_test", "cone_test",     "shading",
    "home_lookup", "cached_lookup", "page_install",  "ray_packing",   "tile_read",   "question_setup"};

/// A number for each Charge.
using ChargeCounts = std::array<std::uint64_t, charge_names.size()>;

/// How these operations are charged. Look-ups, pages and packing are added by the strategies.
inline ChargeCounts charges_of(const Operations& operations) {
  ChargeCounts counts{};
  const auto set = [&counts](Charge charge, std::uint64_t count) { counts[static_cast<std::size_t>(charge)] = count; };
  set(Charge::ray_setup, operations.traced_ray_count());
  set(Charge::cell_step, operations.cell_steps);
  set(Charge::bvh_node_read, operations.bvh_node_reads + operations.instance_entries * bvh_nodes_an_entry);
  set(Charge::triangle_test, operations.primitive_tests[0] + operations.placed_triangles * tests_a_placing);
  set(Charge::sphere_test, operations.primitive_tests[1]);
  set(Charge::cone_test, operations.primitive_tests[2]);
  set(Charge::shading, operations.shadings);
  set(Charge::tile_read, operations.tile_reads);
  return counts;
}

}  // namespace dmpc::core
