// Rays against a whole database: through the grid, and by brute force with the same primitive routines.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/database.h"
#include "core/frame.h"
#include "core/kernel.h"
#include "core/primitive.h"
#include "core/traversal.h"

namespace dmpc::tests {

/// Builds with a page size that is neither the least nor the greatest.
inline core::Database database_of(const core::Scene& scene) { return core::build_database(scene, {}); }

/// A scene seen from far enough away that the pad covers rays from `distance` extents.
inline core::Scene seen_from(core::Scene scene, double distance) {
  core::Vec3d low{1e300, 1e300, 1e300}, high = -low;
  for (const core::Vec3d& v : scene.vertices) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], v[axis]);
      high[axis] = std::max(high[axis], v[axis]);
    }
  }
  const core::Vec3d size = high - low;
  scene.view.at = (low + high) * 0.5;
  scene.view.from = scene.view.at + core::Vec3d{distance * std::max({size.x, size.y, size.z}), 0, 0};
  return scene;
}

inline core::Ray ray_from(const core::Vec3f& origin, const core::Vec3f& direction) {
  core::Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  return ray;
}
/// In grid-local coordinates; the direction is normalised in double, then rounded.
inline core::Ray ray_through(const core::Vec3d& origin, const core::Vec3d& target) {
  const core::Vec3f start(origin);
  return ray_from(start, core::Vec3f(core::normalize(target - core::Vec3d(start))));
}

/// A vertex, centre or end of a primitive, by the row where it starts.
inline core::Vec3d point_of(const core::PrimitiveValues& primitive, std::size_t row) {
  return {double{primitive.value[row]}, double{primitive.value[row + 1]}, double{primitive.value[row + 2]}};
}

/// What tracing answers for one ray; infinity and no primitive for a miss.
inline core::Hit shoot(const core::Database& database, const core::Ray& ray, bool skip_empty_space = true) {
  core::LocalRecords records(database.bytes());
  core::Cursor cursor;
  core::Operations operations;
  const core::TraversalOptions options{.skip_empty_space = skip_empty_space};
  core::trace(ray, cursor, records, database.header(), options, operations);
  return cursor.best;
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
    const float t = primitive.kind == core::PrimitiveKind::triangle ? core::intersect_triangle(sheared, rows, 1, 0)
                    : primitive.kind == core::PrimitiveKind::sphere ? core::intersect_sphere(ray, rows, 1, 0)
                                                                    : core::intersect_cone(ray, rows, 1, 0);
    if (t > 0.0F && t < ray.t_max && core::nearer(t, id, best) && id != ray.ignored_primitive) {
      best.t = t;
      best.primitive = id;
    }
  }
  return best;
}

inline bool same_hit(const core::Hit& a, const core::Hit& b) {
  return std::bit_cast<std::uint32_t>(a.t) == std::bit_cast<std::uint32_t>(b.t) && a.primitive == b.primitive;
}

}  // namespace dmpc::tests
