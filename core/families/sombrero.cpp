// Sombrero: a damped cosine ripple as a height field.
#include <cmath>
#include <numbers>

#include "core/base/elementary.h"
#include "core/families/families.h"

namespace dmpc::core::scenes {
namespace {

/// Sample (row, column) of the surface. It is evaluated on a lattice divided by `width` but placed on one divided by `width - 1`,
/// so the hat is slightly off centre, as in the SPD.
Vec3d surface_point(int row, int column, int width) {
  const double u = -4 + 8.0 * column / width, v = -4 + 8.0 * row / width;
  const double distance = std::sqrt(u * u + v * v);
  const double height = cos_radians(2 * std::numbers::pi * distance) * exponential(-distance);
  return {-4 + 8.0 * column / (width - 1), -3 + height, -4 + 8.0 * row / (width - 1)};
}

}  // namespace

void make_sombrero(int size, SceneSink& sink) {
  set_stage(sink, {.from = {0, 5, -8}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 40, .hither = 0.01}, {{10, 10, -10}});
  sink.material({.color = {1, 0.1, 0.1}, .diffuse = 0.8, .specular = 0, .shine = 2.60078, .refraction_index = 1});
  const int width = 32 << static_cast<unsigned>(size - 1);
  for (int i = 0; i + 1 < width; ++i) {
    for (int j = 0; j + 1 < width; ++j) {
      const Vec3d here = surface_point(i, j, width), across = surface_point(i + 1, j + 1, width);
      sink.polygon({here, across, surface_point(i, j + 1, width)});
      sink.polygon({here, surface_point(i + 1, j, width), across});
    }
  }
}

}  // namespace dmpc::core::scenes
