// Scenes with triangles that cover others in their plane.
#pragma once

#include <array>
#include <vector>

#include "core/base/vec.h"
#include "core/scene/scene.h"

namespace dmpc::tests {

/// Turned about two axes, and moved a little: nothing is along an axis any more.
inline core::Vec3d tilted(const core::Vec3d& p) {
  const core::Vec3d about_x{p.x, 0.8 * p.y - 0.6 * p.z, 0.6 * p.y + 0.8 * p.z};
  return core::Vec3d{0.96 * about_x.x - 0.28 * about_x.z, about_x.y, 0.28 * about_x.x + 0.96 * about_x.z} +
         core::Vec3d{0.013, -0.021, 0.017};
}

/// A level rectangle, tilted or not.
inline std::vector<core::Vec3d> rectangle(const core::Vec3d& low, const core::Vec3d& high, bool is_tilted) {
  std::vector<core::Vec3d> corners{low, {high.x, low.y, low.z}, {high.x, high.y, low.z}, {low.x, high.y, low.z}};
  for (core::Vec3d& corner : corners) {
    corner = is_tilted ? tilted(corner) : corner;
  }
  return corners;
}

inline core::Scene lit_scene() {
  core::Scene scene;
  scene.view = {.from = {2.1, -4.3, 2.9}, .at = {0, 0, 0.3}, .up = {0, 0, 1}, .angle_degrees = 40};
  scene.background = {0.3, 0.4, 0.6};
  scene.lights = {{{4, -3, 6}}, {{-3, -5, 4}}};
  return scene;
}

inline constexpr core::Material floor_material{.color = {0.8, 0.7, 0.5}, .diffuse = 0.8, .specular = 0.2, .shine = 20};
inline constexpr core::Material rug_material{.color = {0.8, 0.1, 0.1}, .diffuse = 0.6, .specular = 0.4, .shine = 10};
inline constexpr core::Material glass_material{
    .color = {1, 1, 1}, .diffuse = 0.1, .specular = 0.2, .shine = 50, .transmittance = 0.8, .refraction_index = 1.5};

inline void add_floor(core::Scene& scene, bool is_tilted) {
  core::SceneBuilder builder(scene);
  builder.material(floor_material);
  builder.polygon(rectangle({-2, -2, 0}, {2, 2, 0}, is_tilted));
}

/// Adds a rug of side x side squares, each of two triangles of their own.
inline void add_rug(core::Scene& scene, bool is_tilted, int side = 1) {
  core::SceneBuilder builder(scene);
  builder.material(rug_material);
  const core::Vec3d step{2.1 / side, 1.9 / side, 0};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const core::Vec3d low{-1 + x * step.x, -1.2 + y * step.y, 0};
      const std::vector<core::Vec3d> at = rectangle(low, low + step, is_tilted);
      builder.polygon({at[0], at[1], at[2]});
      builder.polygon({at[0], at[2], at[3]});
    }
  }
}

/// A rug in a floor's plane, the one before the other in the file.
inline core::Scene rug_on_floor(bool is_tilted, bool rug_first, int side = 1) {
  core::Scene scene = lit_scene();
  if (rug_first) {
    add_rug(scene, is_tilted, side);
  }
  add_floor(scene, is_tilted);
  if (!rug_first) {
    add_rug(scene, is_tilted, side);
  }
  return scene;
}

/// Stands on the plane of the floor.
inline void add_glass_box(core::Scene& scene, bool is_tilted) {
  core::SceneBuilder builder(scene);
  builder.material(glass_material);
  const core::Vec3d a{-0.8, -0.7, 0}, b{0.5, 0.6, 0.9};
  const auto face = [&](std::vector<core::Vec3d> corners) {
    for (core::Vec3d& corner : corners) {
      corner = is_tilted ? tilted(corner) : corner;
    }
    builder.polygon(corners);
  };
  face({{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}});
  face({{a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z}, {a.x, a.y, a.z}});
  face({{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}});
  face({{b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}});
  face({{b.x, b.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}});
  face({{a.x, b.y, a.z}, {a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}});
}

inline core::Scene glass_on_floor(bool is_tilted, bool glass_first) {
  core::Scene scene = lit_scene();
  if (glass_first) {
    add_glass_box(scene, is_tilted);
  }
  add_floor(scene, is_tilted);
  if (!glass_first) {
    add_glass_box(scene, is_tilted);
  }
  return scene;
}

}  // namespace dmpc::tests
