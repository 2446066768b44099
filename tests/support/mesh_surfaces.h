// A scene of the surfaces that mesh files have and NFF has not.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/texture.h"

namespace dmpc::tests {

/// A texel of core::TexelFormat::srgb_alpha.
constexpr std::uint32_t texel_of(std::uint32_t red, std::uint32_t green, std::uint32_t blue, std::uint32_t alpha) {
  return red | green << 8U | blue << 16U | alpha << 24U;
}

inline core::Texture alpha_texture(std::uint32_t width, std::uint32_t height, std::vector<std::uint32_t> texels) {
  core::Texture texture{.format = core::TexelFormat::srgb_alpha, .levels = {{width, height, std::move(texels)}}};
  core::add_levels(texture);
  return texture;
}

/// Leaves: in every other texel of `side` x `side` there is one, greener to the right, and more of it downwards.
inline core::Texture leaves(std::uint32_t side) {
  std::vector<std::uint32_t> texels;
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const bool is_leaf = (row / 2 + column / 2) % 2 == 0;
      texels.push_back(texel_of(90, 100 + 150 * column / side, 30, is_leaf ? 105 + 150 * (row + 1) / side : 0));
    }
  }
  return alpha_texture(side, side, std::move(texels));
}

/// Adds an upright square with its lower left corner at `low`, `size` wide along x, whose corners have these colours.
inline void add_colored_square(core::SceneBuilder& builder, const core::Vec3d& low, double size,
                               const std::vector<core::TexturedCorner>& corners) {
  builder.textured({low, low + core::Vec3d{size, 0, 0}, low + core::Vec3d{size, 0, size}, low + core::Vec3d{0, 0, size}},
                   corners);
}

/// Metals with a tint, highlights that do not mirror, colours of corners, emitters, what is cut out or blended by
/// alpha, smooth and flat, one behind the other, under two lights.
inline core::Scene mesh_surfaces() {
  core::Scene scene;
  scene.name = "mesh surfaces";
  scene.view = {.from = {0.3, -4, 2}, .at = {0, 0, 0.5}, .up = {0, 0, 1}, .angle_degrees = 50};
  scene.background = {0.6, 0.7, 0.9};
  scene.lights = {{{3, -3, 5}}, {{-4, -1, 3}}};
  scene.textures = {leaves(16), leaves(9)};
  core::SceneBuilder builder(scene);
  builder.material({.color = {1, 0.8, 0.3}, .diffuse = 0.3, .shine = 30, .tinted_specular = 0.7});
  builder.polygon({{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}});
  builder.material({.color = {0.2, 0.3, 0.6}, .specular = 0.8, .shine = 12, .specular_color = {1, 0.5, 0.25}, .mirror = 0});
  builder.sphere({0.9, 0.6, 0.7}, 0.7);
  builder.material({.color = {0.1, 0.1, 0.1}, .specular = 0.2, .shine = 9, .emission = {0.5, 0.25, 0.75}});
  builder.cone({-1.5, 1, 0}, 0.5, {-1.5, 1, 1.4}, 0.1);
  builder.material({.diffuse = 0.8, .tinted_specular = 0.2, .mirror = 0.5});
  add_colored_square(builder, {-0.6, 0.5, 0.2}, 1.1,
                     {core::colored_corner({-0.4, -1, 0.2}, {1, 0, 0}), core::colored_corner({0.1, -1, 0.3}, {0, 1, 0}),
                      core::colored_corner({0.1, -1, 0.3}, {0, 0, 1}), core::colored_corner({-0.4, -1, 0.2}, {1, 1, 1})});
  builder.material({.color = {1, 1, 1}, .alpha = core::AlphaUse::blend, .emission = {0.125, 0.0625, 0}});
  add_colored_square(builder, {-1.6, -0.6, 0.1}, 0.9,
                     {core::colored_corner({}, {1, 0.2, 0.2}, 0), core::colored_corner({}, {1, 0.2, 0.2}, 1),
                      core::colored_corner({}, {0.2, 0.2, 1}, 0.5), core::colored_corner({}, {0.2, 1, 0.2}, 0.25)});
  const std::vector<core::TexturedCorner> places{{{}, {0, 1}}, {{}, {2, 1}}, {{}, {2, 0}}, {{}, {0, 0}}};
  builder.material({.color = {0.9, 0.9, 0.9}, .diffuse = 0.9, .texture = 0, .alpha = core::AlphaUse::cut, .alpha_cutoff = 0.5});
  add_colored_square(builder, {-0.3, -1.2, 0.1}, 0.8, places);
  builder.material({.color = {0.9, 0.9, 0.9},
                    .diffuse = 0.8,
                    .specular = 0.2,
                    .shine = 20,
                    .texture = 1,
                    .alpha = core::AlphaUse::blend,
                    .emission = {0, 0, 0.125}});
  add_colored_square(builder, {0.3, -0.8, 0.1}, 1.0, places);
  return scene;
}

}  // namespace dmpc::tests
