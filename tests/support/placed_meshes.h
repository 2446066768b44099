// Scenes in which a mesh stands in several places.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/scene/instances.h"
#include "core/scene/scene.h"
#include "tests/support/covering_faces.h"

namespace dmpc::tests {

/// Turned about two axes and stretched by different amounts, then made `size` times as large and moved; a mirror or not.
inline core::Transform turned_place(double size, const core::Vec3d& shift, bool is_mirrored) {
  core::Transform world{.shift = shift};
  const core::Vec3d origin = tilted({});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    core::Vec3d unit;
    unit[axis] = axis == 2 && is_mirrored ? -1 : 1;
    const core::Vec3d to = tilted(tilted(unit)) - tilted(origin);
    for (std::size_t row = 0; row < 3; ++row) {
      world.rows[row][axis] = to[row] * size * (axis == 1 ? 1.25 : 1);
    }
  }
  return world;
}

/// With the coordinates of a file that keeps them in single precision.
inline core::Scene in_floats(core::Scene scene) {
  for (core::Vec3d& vertex : scene.vertices) {
    vertex = core::Vec3d(core::Vec3f(vertex));
  }
  scene.coordinate_rounding = 0x1p-25;
  return scene;
}

/// All objects of a scene as a mesh in these places, in floats.
inline core::Scene placed(const core::Scene& mesh, const std::vector<core::Transform>& places) {
  core::Scene scene = in_floats(mesh);
  const auto count = static_cast<std::uint32_t>(scene.objects.size());
  core::Instances instances{.meshes = {{0, count}}};
  for (const core::Transform& world : places) {
    instances.places.push_back({world, 0, count});
  }
  core::expand(scene, instances);
  return scene;
}

/// Makes a scene as large as a cube between -1 and 1.
inline void add_far_specks(core::Scene& scene) {
  core::SceneBuilder builder(scene);
  builder.sphere({-1, -1, -1}, 1e-4);
  builder.sphere({1, 1, 1}, 1e-4);
}

}  // namespace dmpc::tests
