// Triangles, spheres and cones scattered over a floor, and rays among them, most of them grazing.
#pragma once

#include <cmath>

#include "apps/lab/bench/stability/mesh.h"
#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/database/database.h"
#include "core/scene/frame.h"

namespace dmpc::apps {

/// Returns triangles, spheres and cones scattered over the floor of a mostly empty room.
inline core::Scene mixed_scene() {
  Random random(21);
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.polygon({{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}});
  for (int i = 0; i < 150; ++i) {
    const core::Vec3d at{random.between(-1, 1), random.between(-1, 1), random.between(0, 0.3)};
    builder.sphere(at, random.between(0.005, 0.05));
    builder.cone(at, 0.02, at + random.in_box(-0.2, 0.2), random.between(0, 0.03));
    builder.polygon({at, at + random.in_box(-0.2, 0.2), at + random.in_box(-0.2, 0.2)});
  }
  add(scene, moved(sphere_mesh(12, 16, 0.1), 0.4, {2, 2, 0.3}));
  return scene;
}

/// Returns a ray from anywhere in the room of mixed_scene() into the crowd.
inline core::Ray random_ray(const core::Database& database, Random& random) {
  const core::GridFrame& frame = database.header().frame;
  return ray_through(to_local(frame, random.in_box(-4, 4)), to_local(frame, {random.between(-1, 1), random.between(-1, 1), 0.1}));
}

/// Returns a ray that meets the plane of a random triangle of the database at 89.84 degrees or more from its normal, near the
/// triangle.
inline core::Ray grazing_ray(const core::Database& database, Random& random) {
  const auto& triangle = database.primitives()[random.below(database.primitives().size())];
  const core::Vec3d a = triangle.vector(0), b = triangle.vector(3), c = triangle.vector(6);
  const core::Vec3d normal = normalize(cross(b - a, c - a));
  const double u = random.unit(), v = random.unit() * (1 - u);
  const core::Vec3d target = a + (b - a) * u + (c - a) * v;
  const core::Vec3d along = normalize(cross(normal, random.direction()));
  const double rise = std::pow(10.0, random.between(-9, -2.76));
  return ray_through(target - (along - normal * rise) * random.between(0.01, 1.5), target);
}

}  // namespace dmpc::apps
