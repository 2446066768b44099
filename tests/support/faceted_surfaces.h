// A scene of surfaces of tiny mirrors, as glTF's metallic-roughness has them.
#pragma once

#include <vector>

#include "core/scene/scene.h"
#include "tests/support/mesh_surfaces.h"
#include "tests/support/noise_texture.h"

namespace dmpc::tests {

/// Noise of metal and of roughness, from half of what there may be on: what is smooth shows each rounding of its roughness.
inline core::Texture facet_noise(std::uint32_t width, std::uint32_t height, core::TextureWrap wrap_s, core::TextureWrap wrap_t) {
  core::Texture texture = noise_texture(width, height, wrap_s, wrap_t, core::TexelFormat::linear);
  texture.levels.resize(1);
  for (std::uint32_t& texel : texture.levels.front().texels) {
    texel |= 0x8000U;
  }
  core::add_levels(texture);
  return texture;
}

/// Metals from mirrors to rough, lacquers, what is half of each, glass, what is veiled, cut out, textured or coloured at its
/// corners, textures of metal and roughness that are finer and coarser than those of colours, one that shines, smooth and flat,
/// one behind the other, under two lights. What approximates them is matt.
inline core::Scene faceted_surfaces() {
  core::Scene scene;
  scene.name = "faceted surfaces";
  scene.view = {.from = {0.3, -4, 2}, .at = {0, 0, 0.5}, .up = {0, 0, 1}, .angle_degrees = 50};
  scene.background = {0.6, 0.7, 0.9};
  scene.lights = {{{3, -3, 5}}, {{-4, -1, 3}}};
  scene.textures = {leaves(16), noise_texture(24, 24, core::TextureWrap::repeat, core::TextureWrap::clamp),
                    facet_noise(9, 32, core::TextureWrap::mirror, core::TextureWrap::repeat),
                    facet_noise(40, 24, core::TextureWrap::clamp, core::TextureWrap::mirror)};
  core::SceneBuilder builder(scene);
  const auto paint = [&builder](const core::Vec3d& color, const core::Microfacets& facets, double index = 1) {
    builder.material({.color = color, .refraction_index = index, .microfacets = facets});
  };
  paint({0.7, 0.6, 0.5}, {.roughness = 0.6});
  builder.polygon({{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}});
  paint({1, 0.75, 0.35}, {.roughness = 0.45, .metallic = 1});
  builder.sphere({0.9, 0.6, 0.7}, 0.7);
  paint({0.9, 0.5, 0.4}, {.roughness = 0, .metallic = 1});
  builder.sphere({-0.5, 1.2, 0.5}, 0.5);
  paint({0.95, 0.95, 0.95}, {.roughness = 0.1, .transmission = 0.9}, 1.5);
  builder.sphere({0.1, -0.9, 0.35}, 0.35);
  builder.material({.color = {0.2, 0.3, 0.6}, .emission = {0.5, 0.25, 0.75}, .microfacets = {.roughness = 0.9, .metallic = 0.5}});
  builder.cone({-1.5, 1, 0}, 0.5, {-1.5, 1, 1.4}, 0.1);
  paint({1, 1, 1}, {.roughness = 0.3, .metallic = 0.5, .opacity = 0.75});
  add_colored_square(builder, {-0.6, 0.2, 0.2}, 0.8,
                     {core::colored_corner({-0.4, -1, 0.2}, {1, 0, 0}), core::colored_corner({0.1, -1, 0.3}, {0, 1, 0}),
                      core::colored_corner({0.1, -1, 0.3}, {0, 0, 1}), core::colored_corner({-0.4, -1, 0.2}, {1, 1, 1})});
  builder.material({.color = {0.9, 0.9, 0.9},
                    .texture = 0,
                    .alpha = core::AlphaUse::cut,
                    .alpha_cutoff = 0.5,
                    .microfacets = {.roughness = 0.5, .metallic = 0.2}});
  add_colored_square(builder, {-1.5, -0.8, 0.1}, 0.8, {{{}, {0, 1}}, {{}, {2, 1}}, {{}, {2, 0}}, {{}, {0, 0}}});
  builder.material({.color = {0.9, 0.8, 0.9},
                    .texture = 0,
                    .alpha = core::AlphaUse::blend,
                    .microfacets = {.roughness = 0.9, .metallic = 0.8, .texture = 3}});
  add_colored_square(builder, {1.2, -0.6, 0.2}, 0.7, {{{}, {0, 1}}, {{}, {1.5, 1}}, {{}, {1.5, 0}}, {{}, {0, 0}}});
  builder.material({.color = {0.8, 0.9, 0.9}, .texture = 1, .microfacets = {.roughness = 0.8, .metallic = 1, .texture = 2}});
  add_colored_square(builder, {-1, -1.4, 0.05}, 0.6,
                     {{{-0.4, -1, 0.2}, {0, 3}}, {{0.1, -1, 0.3}, {3, 3}}, {{0.1, -1, 0.3}, {3, 0}}, {{-0.4, -1, 0.2}, {0, 0}}});
  return scene;
}

}  // namespace dmpc::tests
