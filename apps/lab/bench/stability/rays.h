// Rays in grid-local coordinates, what they are aimed at, and what they hit.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/database/database.h"
#include "core/record/hit.h"
#include "core/record/ray.h"
#include "core/scene/scene.h"
#include "core/trace/traversal.h"

namespace dmpc::apps {

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

/// What tracing answers for one ray; infinity and no primitive for a miss.
inline core::Hit shoot(const core::Database& database, const core::Ray& ray, bool skip_empty_space = true) {
  core::LocalRecords records(database.bytes());
  core::Cursor cursor;
  core::Operations operations;
  const core::Skips skips{.empty_space = skip_empty_space};
  core::trace(ray, cursor, records, database.header(), skips, operations);
  return cursor.best;
}

inline bool same_hit(const core::Hit& a, const core::Hit& b) {
  return std::bit_cast<std::uint32_t>(a.t) == std::bit_cast<std::uint32_t>(b.t) && a.primitive == b.primitive;
}

}  // namespace dmpc::apps
