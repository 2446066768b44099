// Faces next to each other that floats would make one: a poster on a wall in a wide terrain, the two sides of a pane of glass.
#pragma once

#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/base/vec.h"
#include "core/scene/scene.h"
#include "tests/support/covering_faces.h"

namespace dmpc::tests {

/// How things stand in a scene: a place, and directions at right angles, `out` of a wall.
struct Stand {
  core::Vec3d place, right, up, out;

  core::Vec3d at(double x, double y, double off) const { return place + right * x + up * y + out * off; }
};

inline constexpr Stand along_axes{{7300, 4100, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
/// Turned about the vertical by an angle of sine 0.28: no coordinate is the same on all of the wall.
inline constexpr Stand turned_round{{7300, 4100, 0}, {0.96, 0.28, 0}, {0, 0, 1}, {0.28, -0.96, 0}};

/// Lying, so that what is off the ground is so by very little.
inline constexpr Stand floor_of_all{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// A rectangle of a stand's, which leans: its upper edge is farther off by `leaning`.
inline std::vector<core::Vec3d> rectangle_of(const Stand& stand, const core::Vec3d& low, const core::Vec3d& high,
                                             double leaning = 0) {
  return {stand.at(low.x, low.y, low.z), stand.at(high.x, low.y, low.z), stand.at(high.x, high.y, low.z + leaning),
          stand.at(low.x, high.y, low.z + leaning)};
}

inline void add(core::SceneBuilder& builder, const std::vector<core::Vec3d>& corners, bool in_triangles) {
  if (!in_triangles) {
    builder.polygon(corners);
    return;
  }
  builder.polygon({corners[0], corners[1], corners[2]});
  builder.polygon({corners[0], corners[2], corners[3]});
}

inline constexpr double half_terrain = 10'000;

/// So many small things elsewhere that local zero does not lie at the wall.
inline void add_detail_elsewhere(core::SceneBuilder& builder) {
  apps::Random random(7);
  for (const core::Vec3d& middle : {core::Vec3d{-7300, -4100, 0}, core::Vec3d{-7300, 4100, 0}, core::Vec3d{7300, -4100, 0}}) {
    for (int i = 0; i < 40; ++i) {
      builder.sphere(middle + random.in_box(-20, 20), 0.5);
    }
  }
}

/// A wall of 6 x 4 on a wide terrain, and `off` it a poster of 1 x 1.
inline core::Scene poster_scene(const Stand& stand, double off, double leaning, bool in_triangles,
                                bool has_detail_elsewhere = true) {
  core::Scene scene = lit_scene();
  core::SceneBuilder builder(scene);
  builder.material(floor_material);
  builder.polygon({{-half_terrain, -half_terrain, 0},
                   {half_terrain, -half_terrain, 0},
                   {half_terrain, half_terrain, 0},
                   {-half_terrain, half_terrain, 0}});
  builder.polygon({{-half_terrain, -half_terrain, 0}, {-half_terrain, half_terrain, 0}, {-half_terrain, 0, 1000}});
  add(builder, rectangle_of(stand, {-3, 0, 0}, {3, 4, 0}), in_triangles);
  builder.material(rug_material);
  add(builder, rectangle_of(stand, {-0.5, 1, off}, {0.5, 2, off}, leaning), in_triangles);
  if (has_detail_elsewhere) {
    add_detail_elsewhere(builder);
  }
  scene.view = {.from = stand.at(0.4, 1.6, 3), .at = stand.at(0, 1.5, 0), .up = {0, 0, 1}, .angle_degrees = 45};
  return scene;
}

/// A pane of glass, upright, tilted or not, between a checkered wall and the eye.
inline core::Scene pane_scene(double thickness, bool is_tilted) {
  core::Scene scene = lit_scene();
  core::SceneBuilder builder(scene);
  const auto turned = [&](std::vector<core::Vec3d> corners) {
    for (core::Vec3d& corner : corners) {
      corner = is_tilted ? tilted(corner) : corner;
    }
    return corners;
  };
  builder.material(floor_material);
  builder.polygon(turned({{-5, -5, -1.2}, {5, -5, -1.2}, {5, 5, -1.2}, {-5, 5, -1.2}}));
  builder.material(rug_material);
  for (int i = -2; i <= 2; ++i) {
    builder.sphere(turned({{double(i), 2, 0}})[0], 0.4);
  }
  builder.material(glass_material);
  const double front = -0.3, back = -0.3 + thickness;
  builder.polygon(turned({{-1.5, front, -1}, {1.5, front, -1}, {1.5, front, 1.4}, {-1.5, front, 1.4}}));
  builder.polygon(turned({{-1.5, back, -1}, {-1.5, back, 1.4}, {1.5, back, 1.4}, {1.5, back, -1}}));
  const std::vector<core::Vec3d> view = turned({{0.7, -6, 2}, {0, 0, 0}, {0, 0, 1}, {0, 0, 0}});
  scene.view = {.from = view[0], .at = view[1], .up = view[2] - view[3], .angle_degrees = 45};
  return scene;
}

}  // namespace dmpc::tests
