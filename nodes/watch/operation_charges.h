// What the operations of a ray tracer are charged as.
#pragma once

#include "core/trace/operations.h"
#include "nodes/charge.h"

namespace dmpc::nodes {

/// Rays, walk, tests, shading and textures. Look-ups, pages and packing are the strategies' to add.
inline Charges charges_of(const core::Operations& operations) {
  Charges charges;
  charges[Charge::ray_setup] = operations.traced_ray_count();
  charges[Charge::cell_step] = operations.cell_steps;
  charges[Charge::brick_read] = operations.brick_reads;
  charges[Charge::triangle_test] = operations.primitive_tests[0];
  charges[Charge::sphere_test] = operations.primitive_tests[1];
  charges[Charge::cone_test] = operations.primitive_tests[2];
  charges[Charge::shading] = operations.shadings;
  charges[Charge::tile_read] = operations.tile_reads;
  return charges;
}

}  // namespace dmpc::nodes
