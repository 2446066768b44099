// Lattice: mirroring balls on the points of a cubic lattice, joined by rods.
#include <array>

#include "core/families/families.h"

namespace dmpc::core::scenes {
namespace {

const Material ball_material = {
    .color = {0.9, 0.9, 0.9}, .diffuse = 0.5, .specular = 0.5, .shine = soft_highlight, .refraction_index = 0};

Material rod_material(std::size_t axis) {
  Vec3d color = {0.1, 0.1, 0.1};
  color[axis] = 0.9;
  return {.color = color, .diffuse = 0.99, .specular = 0, .shine = no_highlight, .refraction_index = 0};
}

/// The rod from a point to its neighbour along an axis; its ends lie just inside the balls.
void add_rod(const Vec3d& point, std::size_t axis, double cell, SceneSink& sink) {
  const double ball_radius = cell / 4, rod_radius = cell / 16;
  const double inset = 0.99 * ball_radius * (1 - 0.5);
  Vec3d base = point, apex = point;
  base[axis] += inset;
  apex[axis] += cell - inset;
  sink.material(rod_material(axis));
  sink.cone(base, rod_radius, apex, rod_radius);
}

void add_point(const std::array<int, 3>& index, int size, SceneSink& sink) {
  const double cell = 1.0 / size;
  const auto place = [size](int i) { return static_cast<double>(i) / size; };
  const Vec3d point = {place(index[0]), place(index[1]), place(index[2])};
  sink.material(ball_material);
  sink.sphere(point, cell / 4);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (index[axis] < size) {
      add_rod(point, axis, cell, sink);
    }
  }
}

}  // namespace

void make_lattice(int size, SceneSink& sink) {
  const double middle = (static_cast<double>(size / 2) + 0.5) / size;
  const double half_cell = 1 / (2.0 * size);
  set_stage(sink,
            {.from = {middle, 1, 1 - half_cell},
             .at = {middle, -1, -1 - half_cell},
             .up = {0.2, 1, 0},
             .angle_degrees = 60,
             .hither = 0},
            {{2, 0.5, 0.5}, {-1, 0.5, 0.5}, {0.5, 2, 0.5}, {0.5, -1, 0.5}, {0.5, 0.5, 2}, {0.5, 0.5, -1}});
  for (int x = 0; x <= size; ++x) {
    for (int y = 0; y <= size; ++y) {
      for (int z = 0; z <= size; ++z) {
        add_point({x, y, z}, size, sink);
      }
    }
  }
}

}  // namespace dmpc::core::scenes
