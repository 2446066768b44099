// Small things beside bodies that are large: balls that mirror on the side of a planet, a pipe or a mountain, and in a room whose
// walls are balls.
#pragma once

#include <cmath>

#include "core/scene/scene.h"

namespace dmpc::tests {

inline core::Scene small_things() {
  core::Scene scene;
  scene.background = {0.15, 0.3, 0.6};
  scene.view = {.from = {0.4, -5.7, 2.3}, .at = {0.1, 0, 0.2}, .up = {0, 0, 1}, .angle_degrees = 42};
  core::SceneBuilder builder(scene);
  builder.light({.position = {3.7, -2.9, 5.3}});
  builder.light({.position = {-3.1, -4.2, 3.6}});
  builder.material({.color = {0.4, 0.7, 0.8}, .diffuse = 0.7, .specular = 0.3, .shine = 25});
  builder.sphere({-0.3, 0.2, 0.1}, 1);
  builder.sphere({1.4, 0.3, -0.55}, 0.4);
  builder.cone({-1.7, 0.9, -1.02}, 0.35, {-1.6, 1.1, 0.8}, 0.1);
  builder.material({.color = {0.85, 0.6, 0.3}, .diffuse = 0.6, .specular = 0.4, .shine = 15});
  return scene;
}

enum class LargeBody { planet, pipe, mountain, room };

/// They lie, or hover, about 1 below the middle; no number of the large bodies is round.
inline core::Scene beside_large(LargeBody body, double radius) {
  core::Scene scene = small_things();
  core::SceneBuilder builder(scene);
  const core::Vec3d down = normalize(core::Vec3d{0.013, -0.021, -1}), along = normalize(cross(down, {0.3, 0.1, 0.02}));
  switch (body) {
    case LargeBody::planet:
      builder.sphere(down * (radius + 1.03), radius);
      break;
    case LargeBody::pipe:
      builder.cone(down * (radius + 1.03) - along * (radius * 1.1), radius, down * (radius + 1.03) + along * (radius * 0.9),
                   radius);
      break;
    case LargeBody::mountain: {
      const double low = 1.3 * radius, high = 0.6 * radius, at_zero = low + (high - low) * 0.55, height = 2 * radius;
      // Its side passes 1.03 below the middle: across it, by as much as it leans more.
      const double off = at_zero + 1.03 * std::hypot(1.0, (high - low) / height);
      builder.cone(down * off - along * (height * 0.55), low, down * off + along * (height * 0.45), high);
      break;
    }
    case LargeBody::room:
      for (const core::Vec3d& side : {down, -down, along, -along, cross(down, along), -cross(down, along)}) {
        builder.sphere(side * (radius + (side == down ? 1.03 : 7.1)), radius);
      }
      break;
  }
  return scene;
}

}  // namespace dmpc::tests
