// Scenes small enough to render many times, that use everything: mirrors, glass, every kind of primitive, many lights.
#pragma once

#include <cmath>
#include <string_view>

#include "core/families/scenes.h"
#include "core/scene/scene.h"
#include "tests/support/noise_texture.h"

namespace dmpc::tests {

inline core::Scene built_in(std::string_view name) { return core::built_in_scene(core::parse_scene_name(name)); }

/// A floor, a mirror, a glass ball, a cylinder, a cone and a smooth patch under three lights, one of them coloured.
inline core::Scene mirrors_and_glass() {
  core::Scene scene;
  scene.name = "mirrors and glass";
  scene.view = {.from = {0.3, -4, 2}, .at = {0, 0, 0.5}, .up = {0, 0, 1}, .angle_degrees = 50};
  scene.background = {0.1, 0.2, 0.4};
  scene.lights = {{{3, -3, 5}}, {{-4, -1, 3}}, {{0, 2, 6}, {0.9, 0.5, 0.2}, true}};
  core::SceneBuilder builder(scene);
  builder.material({.color = {0.8, 0.7, 0.5}, .diffuse = 0.8, .specular = 0.2, .shine = 20});
  builder.polygon({{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}});
  builder.polygon({{-2, 2, 0}, {2, 2, 0}, {2, 2, 3}, {0, 2, 1}, {-2, 2, 3}});  // concave
  builder.material(
      {.color = {1, 1, 1}, .diffuse = 0.1, .specular = 0.2, .shine = 50, .transmittance = 0.8, .refraction_index = 1.5});
  builder.sphere({-0.7, -0.6, 0.6}, 0.6);
  builder.material({.color = {0.9, 0.9, 0.9}, .diffuse = 0.2, .specular = 0.7, .shine = 80});
  builder.sphere({0.9, 0.3, 0.7}, 0.7);
  builder.cone({-1.5, 1, 0}, 0.5, {-1.5, 1, 1.4}, 0.1);
  builder.cone({0.2, -1.5, 0.3}, 0.2, {1.4, -1.2, 0.3}, 0.2);
  builder.patch({{-0.4, 1.2, 0.2}, {0.6, 1.3, 0.2}, {0.1, 1.2, 1.4}}, {{-0.5, -1, 0}, {0.5, -1, 0}, {0, -1, 0.8}});
  return scene;
}

/// Adds a wall with a texture that repeats, and a leaning, smooth one with a texture of another kind that does not.
inline void add_textured_walls(core::Scene& scene) {
  scene.textures.push_back(noise_texture(50, 33));
  scene.textures.push_back(
      noise_texture(24, 24, core::TextureWrap::clamp, core::TextureWrap::mirror, core::TexelFormat::shared_exponent));
  const auto last = static_cast<std::uint32_t>(scene.textures.size() - 1);
  core::SceneBuilder builder(scene);
  builder.material({.color = {0.9, 0.8, 0.7}, .texture = last - 1});
  builder.textured({{-1, -2.4, 0.1}, {-0.3, -2.3, 0.1}, {-0.3, -2.3, 0.6}, {-1, -2.4, 0.6}},
                   {{{}, {0, 3}}, {{}, {4, 3}}, {{}, {4, 0}}, {{}, {0, 0}}});
  builder.material({.color = {0.01, 0.01, 0.01}, .diffuse = 0.8, .specular = 0.2, .shine = 10, .texture = last});
  builder.textured({{0.6, -2.5, 0.1}, {1.2, -2.4, 0.1}, {0.9, -2.4, 0.7}},
                   {{{-1, -1, 0}, {-0.5, 1.5F}}, {{1, -1, 0.5}, {1.5, 1.5}}, {{0, -1, 0}, {0.5, -1}}});
}

/// Mirrors and glass, and what other scenes hardly have: a black light, a black triangle, a pane that light cannot leave, specks
/// high above the rest, and textures.
inline core::Scene everything() {
  core::Scene scene = mirrors_and_glass();
  scene.name = "everything";
  scene.lights.push_back({{2, -4, 3}, {0, 0, 0}, true});
  core::SceneBuilder builder(scene);
  builder.material({.color = {0, 0, 0}, .diffuse = 1, .specular = 0});
  builder.polygon({{-1, -2, 0.1}, {1, -2, 0.1}, {0, -1, 0.1}});
  builder.material({.diffuse = 0.1, .specular = 0.2, .transmittance = 0.5, .refraction_index = 1.5});
  builder.polygon({{1.5, -2, 0.5}, {1.2, -1.4, 0.5}, {1.5, -2, 1.3}});
  builder.material({});
  for (int i = 0; i < 100; ++i) {
    builder.sphere({2.6, 2.6, 0.08 * (i + 1)}, 0.01);
  }
  add_textured_walls(scene);
  return scene;
}

/// Nothing but a small tetrahedron fractal under 1,000 lights.
inline core::Scene thousand_lights() {
  core::Scene scene = built_in("tetra-3");
  scene.name = "a thousand lights";
  scene.lights.clear();
  for (int i = 0; i < 1000; ++i) {
    const double height = (i + 0.5) / 500 - 1, angle = 2.399963 * i, radius = std::sqrt(1 - height * height);
    scene.lights.push_back({{9 * radius * std::cos(angle), 9 * radius * std::sin(angle), 9 * height}});
  }
  return scene;
}

}  // namespace dmpc::tests
