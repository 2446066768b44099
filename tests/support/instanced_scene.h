// Scenes of seeds in which meshes stand in many places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/base/vec.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"

namespace dmpc::tests {

struct InstancedScene {
  core::Scene scene;
  core::Instances instances;
};

/// First `inner`, then `outer`.
inline core::Transform composed(const core::Transform& outer, const core::Transform& inner) {
  core::Transform both{.shift = outer.point(inner.shift)};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      both.rows[row][column] = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        both.rows[row][column] += outer.rows[row][i] * inner.rows[i][column];
      }
    }
  }
  return both;
}

/// Turned at will, stretched by up to a half, from a thousandth to a thousand times as large; in half of the cases a mirror.
inline core::Transform place_anywhere(apps::Random& random) {
  constexpr double sizes[] = {1e-3, 0.1, 1, 1, 30, 1e3};
  const double size = sizes[random.below(6)], side = random.below(2) == 0 ? 1 : -1;
  core::Transform world{.shift = random.in_box(-2, 2) * size};
  const core::Vec3d x = random.direction(), y = normalize(cross(x, random.direction())), z = cross(x, y) * side;
  world.rows = {x * (size * random.between(1, 1.5)), y * size, z * (size * random.between(1, 1.5))};
  return world;
}

inline void add_any_face(apps::Random& random, core::SceneBuilder& builder) {
  const core::Vec3d at = random.in_box(-1, 1);
  const std::vector<core::Vec3d> corners{at, at + random.direction() * 0.2, at + random.direction() * 0.2};
  switch (random.below(4)) {
    case 0:
      return builder.patch(corners, {random.direction(), random.direction(), random.direction()});
    case 1:
      return builder.textured(corners, {core::colored_corner({}, {1, 0, 0}), core::colored_corner({}, {0, 1, 0}),
                                        core::colored_corner({}, {0, 0, 1})});
    case 2:
      return builder.textured(corners, {core::colored_corner(random.direction(), {1, 0, 0}),
                                        core::colored_corner(random.direction(), {0, 1, 0}), core::colored_corner({}, {})});
    default:
      return builder.polygon(corners);
  }
}

/// Four meshes, one of them so small that it is copied, in some forty places, among them such as press them flat and such as are
/// two, one in the other; before, between and behind them objects that stand where they are, round ones, too.
inline InstancedScene instanced_scene(std::uint64_t seed) {
  apps::Random random(seed);
  InstancedScene result;
  core::SceneBuilder builder(result.scene);
  for (const std::uint32_t size : {70U, 10U, 150U, 65U}) {
    builder.sphere(random.in_box(-3, 3), random.between(0.01, 0.5));
    const auto first = static_cast<std::uint32_t>(result.scene.objects.size());
    for (std::uint32_t i = 0; i < size; ++i) {
      add_any_face(random, builder);
    }
    result.instances.meshes.push_back({first, static_cast<std::uint32_t>(result.scene.objects.size())});
    add_any_face(random, builder);
    for (std::uint32_t i = random.below(20); i > 0; --i) {
      core::Transform world = place_anywhere(random);
      if (i % 3 == 0) {
        world = composed(place_anywhere(random), world);
      }
      if (i % 5 == 0) {
        world.rows[2] = world.rows[1];
      }
      const std::uint32_t mesh = random.below(result.instances.meshes.size());
      result.instances.places.push_back({world, mesh, static_cast<std::uint32_t>(result.scene.objects.size())});
    }
  }
  builder.cone(random.in_box(-3, 3), 0.2, random.in_box(-3, 3), 0);
  return result;
}

}  // namespace dmpc::tests
