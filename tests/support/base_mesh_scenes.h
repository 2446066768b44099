// Scenes whose meshes may be kept once: of all surfaces that a mesh may have, in many places.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"
#include "tests/support/covering_faces.h"
#include "tests/support/mesh_surfaces.h"
#include "tests/support/placed_meshes.h"

namespace dmpc::tests {

/// Adds a wavy ball about the origin, in floats: mirrors, glass, smooth faces, textures with holes and without, colours of
/// corners, side by side. Normals are not of unit length.
inline void add_patched_ball(core::Scene& scene, int side) {
  using core::Vec3d;
  core::SceneBuilder builder(scene);
  const auto point = [&](int row, int column) {
    const double up = std::numbers::pi * row / side, round = std::numbers::pi * (column % (2 * side)) / side;
    const double radius = 1 + 0.1 * std::sin(5 * round) * std::sin(3 * up);
    return Vec3d(core::Vec3f(Vec3d{std::sin(up) * std::cos(round), std::sin(up) * std::sin(round), std::cos(up)} * radius));
  };
  const core::Material materials[] = {{.color = {0.9, 0.7, 0.4}, .diffuse = 0.8},
                                      {.color = {0.4, 0.6, 0.9}, .diffuse = 0.5, .specular = 0.5, .shine = 20},
                                      {.diffuse = 0.1, .specular = 0.1, .transmittance = 0.8, .refraction_index = 1.4},
                                      {.diffuse = 0.9, .texture = 0, .alpha = core::AlphaUse::cut, .alpha_cutoff = 0.5},
                                      {.diffuse = 0.8, .specular = 0.2, .texture = 1, .alpha = core::AlphaUse::blend},
                                      {.diffuse = 0.9}};
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < 2 * side; ++column) {
      std::vector<Vec3d> corners{point(row, column), point(row + 1, column), point(row + 1, column + 1), point(row, column + 1)};
      if (row == 0 || row == side - 1) {
        corners.erase(corners.begin() + (row == 0 ? 3 : 1));  // two are the pole
      }
      const int kind = (row * 3 + column) % 6;
      builder.material(materials[kind]);
      std::vector<core::TexturedCorner> textured;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const float s = i == 0 || i == 3 ? 0.0F : 1.5F, t = i < 2 ? 0.0F : 1.0F;
        textured.push_back(kind == 5 ? core::colored_corner(corners[i] * 0.5, {i == 0 ? 1.0 : 0.2, 0.5, i == 2 ? 0.9 : 0.1})
                                     : core::TexturedCorner{kind == 3 ? Vec3d{} : corners[i] * 0.25, {s, t}});
      }
      kind == 0 ? builder.polygon(corners) : kind < 3 ? builder.patch(corners, corners) : builder.textured(corners, textured);
    }
  }
}

enum class Arrangement : std::uint8_t { apart, deep_in_each_other, coincident };

/// Patched balls of this size, beside the scene's 4, and rugs that lie in their floor: a third of them mirrors, all turned and
/// stretched, some before and some behind what stands for itself.
inline core::Scene balls_in_places(double size, Arrangement arrangement, std::uint64_t seed,
                                   core::Copies copies = core::Copies::put) {
  core::Scene scene = lit_scene();
  scene.textures = {leaves(16), leaves(9)};
  apps::Random random(seed);
  add_patched_ball(scene, 8);
  const auto ball_end = static_cast<std::uint32_t>(scene.objects.size());
  const bool is_tilted = seed % 2 == 0;
  add_rug(scene, is_tilted, 6);
  add_floor(scene, is_tilted);
  const auto mesh_end = static_cast<std::uint32_t>(scene.objects.size());
  for (core::Vec3d& vertex : scene.vertices) {
    vertex = core::Vec3d(core::Vec3f(vertex));
  }
  add_floor(scene, false);
  core::Instances instances{.meshes = {{0, ball_end}, {ball_end, mesh_end}}};
  for (std::uint32_t i = 0; i < 18; ++i) {
    const core::Vec3d way = random.in_box(-1, 1);
    const core::Vec3d at = arrangement == Arrangement::apart        ? core::Vec3d{way.x * 1.5, way.y * 1.5, 0.5 + way.z * 0.5}
                           : arrangement == Arrangement::coincident ? core::Vec3d{0.1, 0.2, 0.5}
                                                                    : core::Vec3d{0.1, 0.2, 0.5} + way * (0.5 * size);
    const double stretch = arrangement == Arrangement::coincident ? 1 : std::exp2(random.in_box(-1, 1).x);
    instances.places.push_back({turned_place(size * stretch, at, i % 3 == 0), i % 4 == 1 ? 1U : 0U, mesh_end + (i >= 9 ? 1 : 0)});
  }
  core::settle(scene, instances, copies);
  core::SceneBuilder(scene).sphere({0.4, -1, 0.3}, 0.3);
  return scene;
}

/// A sheet of 72 triangles that stands on the floor, in this material.
inline void add_sheet(core::Scene& scene, const core::Material& material) {
  core::SceneBuilder builder(scene);
  builder.material(material);
  const auto at = [](int row, int column) { return core::Vec3d{column / 8.0, 0.25 * (row % 2), row / 8.0}; };
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      builder.polygon({at(row, column), at(row, column + 1), at(row + 1, column)});
      builder.polygon({at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)});
    }
  }
}

/// Balls in twelve places, and among these what has to have copies: four lamps, four sheets with a corner that no float holds, a
/// ball too small beside the scene and one too far away.
inline core::Scene with_obstacles(core::Copies copies) {
  core::Scene scene = lit_scene();
  scene.textures = {leaves(16), leaves(9)};
  add_patched_ball(scene, 8);
  const auto ball_end = static_cast<std::uint32_t>(scene.objects.size());
  add_sheet(scene, {.color = {0.9, 0.8, 0.5}, .diffuse = 0.5, .emission = {3, 2, 1}});
  const auto lamp_end = static_cast<std::uint32_t>(scene.objects.size());
  for (core::Vec3d& vertex : scene.vertices) {
    vertex = core::Vec3d(core::Vec3f(vertex));
  }
  add_sheet(scene, rug_material);
  const auto end = static_cast<std::uint32_t>(scene.objects.size());
  scene.vertices.back().x += 1e-12;
  add_floor(scene, false);
  core::Instances instances{.meshes = {{0, ball_end}, {ball_end, lamp_end}, {lamp_end, end}}};
  apps::Random random(7);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const core::Vec3d at = random.in_box(-1, 1) + core::Vec3d{0, 0, 1};
    const std::uint32_t mesh = i % 5 == 1 ? 1 : i % 5 == 3 ? 2 : 0;
    instances.places.push_back({turned_place(0.3 + 0.02 * i, at, i % 3 == 0), mesh, end + (i >= 9 ? 1 : 0)});
    if (i == 8 || i == 14) {
      const bool is_small = i == 8;
      instances.places.push_back(
          {turned_place(is_small ? 1e-14 : 0.1, {0, is_small ? 0 : 1e31, 0}, false), 0, end + (is_small ? 0 : 1)});
    }
  }
  core::settle(scene, instances, copies);
  core::SceneBuilder(scene).sphere({0.4, -1, 0.3}, 0.3);
  return scene;
}

/// Patched balls in a field of so many along a side, beside a floor and a sphere.
inline core::Scene field_of_balls(std::uint32_t side, int ball_side = 8) {
  core::Scene scene = lit_scene();
  scene.textures = {leaves(16), leaves(9)};
  add_patched_ball(scene, ball_side);
  const auto end = static_cast<std::uint32_t>(scene.objects.size());
  core::Instances instances{.meshes = {{0, end}}};
  const double step = 2.0 / side;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const double x = -1 + (i % side) * step, y = -1 + static_cast<double>(i / side) * step;
    instances.places.push_back({turned_place(0.3 * step, {x, y, 0.1}, i % 2 == 0), 0, end});
  }
  core::settle(scene, instances, core::Copies::put);
  add_floor(scene, false);
  core::SceneBuilder(scene).sphere({0.4, -1, 0.3}, 0.3);
  return scene;
}

inline core::BuildOptions with_copies(std::size_t page_size_bytes = 1024) {
  return {.page_size_bytes = page_size_bytes, .structure = core::Structure::extents};
}
inline core::BuildOptions with_instances(std::size_t page_size_bytes = 1024) {
  return {.page_size_bytes = page_size_bytes, .structure = core::Structure::extents, .keeps_instances = true};
}

}  // namespace dmpc::tests
