// A floor of coloured checks, twice: as a texture, and as polygons.
#pragma once

#include <array>
#include <cstdint>

#include "core/scene/scene.h"
#include "core/scene/texel.h"

namespace dmpc::tests {

/// Checks that no exchange, turn or reflection leaves alone: 3 by 2 in a period, each of another colour, in a rectangle that is
/// longer than wide. A mirror above shows them again.
class CheckedFloor {
 public:
  static constexpr std::uint32_t columns = 3, rows = 2;
  static constexpr double check_width = 0.5, check_length = 0.8;
  static constexpr std::uint32_t periods = 6;  ///< along each side

  static core::Scene painted() {
    core::Scene scene = room();
    core::Texture texture{.name = "checks", .levels = {{columns * texels, rows * texels, {}}}};
    for (std::uint32_t row = 0; row < rows * texels; ++row) {
      for (std::uint32_t column = 0; column < columns * texels; ++column) {
        texture.levels.front().texels.push_back(core::encoded({}, color(column / texels, row / texels)));
      }
    }
    core::add_levels(texture);
    scene.textures.push_back(texture);
    core::SceneBuilder builder(scene);
    builder.material({.color = {1, 1, 1}, .texture = 0});
    const float end = periods;
    // Seen from above: s grows with x, t with y.
    builder.textured(
        {place(0, 0), place(columns * periods, 0), place(columns * periods, rows * periods), place(0, rows * periods)},
        {{{}, {0, 0}}, {{}, {end, 0}}, {{}, {end, end}}, {{}, {0, end}}});
    return scene;
  }

  static core::Scene laid() {
    core::Scene scene = room();
    core::SceneBuilder builder(scene);
    for (std::uint32_t row = 0; row < rows * periods; ++row) {
      for (std::uint32_t column = 0; column < columns * periods; ++column) {
        const core::Color light = core::decoded({}, core::encoded({}, color(column % columns, row % rows)));
        builder.material({.color = core::Vec3d(light)});
        builder.polygon({place(column, row), place(column + 1, row), place(column + 1, row + 1), place(column, row + 1)});
      }
    }
    return scene;
  }

 private:
  static constexpr std::uint32_t texels = 64;  ///< along a check

  static core::Vec3d color(std::uint32_t column, std::uint32_t row) {
    constexpr std::array<core::Vec3d, std::size_t{columns} * rows> colors{core::Vec3d{1, 1, 1}, {0, 0, 0},       {0.9, 0.1, 0},
                                                                          {0, 0, 0.05},         {0.1, 0.8, 0.1}, {0, 0.2, 1}};
    return colors[row * columns + column];
  }
  static core::Vec3d place(std::uint32_t column, std::uint32_t row) {
    return {column * check_width - columns * periods * check_width / 2, row * check_length - 1, 0};
  }
  static core::Scene room() {
    core::Scene scene;
    scene.name = "checks";
    scene.view = {.from = {0.4, -2.5, 0.9}, .at = {0, 3, 0.4}, .up = {0, 0, 1}, .angle_degrees = 55};
    scene.background = {0.1, 0.1, 0.1};
    scene.lights = {{{-6, 2, 1.5}, {1, 1, 1}, true}};  // at a slant, so that angles count
    core::SceneBuilder builder(scene);
    builder.material({.color = {0, 0, 0}, .diffuse = 0, .specular = 0.9, .shine = 1e6});
    builder.polygon({{-3, 6, 0.6}, {3, 6.5, 0.6}, {3, 4, 2.6}, {-3, 3.5, 2.6}});
    return scene;
  }
};

}  // namespace dmpc::tests
