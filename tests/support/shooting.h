// Rays against a whole database: through the grid, and by brute force with the same primitive routines.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "apps/lab/bench/stability/cells.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/database/database.h"
#include "core/scene/frame.h"
#include "core/trace/kernel.h"
#include "core/trace/primitive.h"
#include "core/trace/traversal.h"

namespace dmpc::tests {

/// Builds with a page size that is neither the least nor the greatest, and with several macro cells.
inline core::Database database_of(const core::Scene& scene) {
  return core::build_database(scene, apps::several_macro_cells(scene));
}

/// Two walks have looked at the same cells, BVH nodes and primitives.
inline void check_same_traversal(const core::Operations& one, const core::Operations& other) {
  CHECK(one.cell_steps == other.cell_steps);
  CHECK(one.bvh_node_reads == other.bvh_node_reads);
  CHECK(one.primitive_tests == other.primitive_tests);
}

/// A triangle by the scalar routines.
inline float intersect(const core::Database& database, const core::PrimitiveValues& triangle, const core::ShearedRay& sheared) {
  const float* rows = triangle.value.data();
  if (triangle.plane() == 0) {
    return core::intersect_triangle(sheared, rows, 1, 0);
  }
  const core::PrimitivePlane plane =
      triangle.needs_plane() ? database.planes()[triangle.plane() - 1] : core::PrimitivePlane{core::level_plane_of(rows, 1, 0)};
  const core::LeafHeader header{.plane = plane.stored_as};
  const float t = core::intersect_shared_face(sheared, core::depth_of(sheared, plane), rows, 1, 0);
  return header.has_exact_plane() ? core::in_layer(t, sheared, plane, header.layer()) : t;
}

/// Every primitive by the scalar routines, in order.
inline core::Hit brute_force(const core::Database& database, const core::Ray& ray) {
  core::Hit best;
  const core::ShearedRay sheared(ray);
  if (!core::is_finite(ray.origin) || !core::is_finite(ray.direction)) {
    return best;
  }
  for (std::uint32_t id = 0; id < database.primitives().size(); ++id) {
    const core::PrimitiveValues& primitive = database.primitives()[id];
    const float* rows = primitive.value.data();
    const float t = primitive.kind == core::PrimitiveKind::triangle ? intersect(database, primitive, sheared)
                    : primitive.kind == core::PrimitiveKind::sphere ? core::intersect_sphere(ray, rows, 1, 0)
                                                                    : core::intersect_cone(ray, rows, 1, 0);
    if (t > 0.0F && t < ray.t_max && core::nearer(t, id, best) && id != ray.ignored_primitive) {
      best.t = t;
      best.primitive = id;
    }
  }
  return best;
}

}  // namespace dmpc::tests
