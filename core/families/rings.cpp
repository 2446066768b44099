// Rings: a pyramid of objects of six interlocked rings, each of five rods and five balls, before a wall.
#include <array>
#include <cmath>

#include "core/families/families.h"
#include "core/families/frame.h"

namespace dmpc::core::scenes {
namespace {

constexpr std::size_t ring_count = 6, point_count = 5;
constexpr double rod_radius = 0.07412;
constexpr std::array<Vec3d, ring_count> ring_colors = {Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}};

using Ring = std::array<Vec3d, point_count>;
using Rings = std::array<Ring, ring_count>;

Ring flat_ring() {
  Ring ring;
  const double radius = 1 / (1 + rod_radius);
  for (std::size_t k = 0; k < point_count; ++k) {
    const double degrees = 72.0 * static_cast<double>(k);
    ring[k] = {radius * cos_degrees(degrees), radius * sin_degrees(degrees), 0};
  }
  return ring;
}

/// The tilt of rings 1 to 5: twice the angle whose cosine is cos 60 / sin 36 degrees.
Turn ring_tilt() {
  const double cosine = cos_degrees(60) / sin_degrees(36);
  return {2 * cosine * std::sqrt(1 - cosine * cosine), 2 * cosine * cosine - 1};
}

Rings six_rings() {
  Rings rings;
  rings[0] = flat_ring();
  const Frame tilt = rotation_x(ring_tilt());
  for (std::size_t m = 1; m < ring_count; ++m) {
    const Frame frame = compose(rotation_z(turn_degrees(36.0 * (2.0 * static_cast<double>(m) - 1))), tilt);
    for (std::size_t k = 0; k < point_count; ++k) {
      rings[m][k] = frame.vector(rings[0][k]);
    }
  }
  return rings;
}

void add_object(const Rings& rings, const Vec3d& offset, SceneSink& sink) {
  for (std::size_t m = 0; m < ring_count; ++m) {
    sink.material({.color = ring_colors[m], .diffuse = 0.5, .specular = 0.2, .shine = soft_highlight, .refraction_index = 0});
    for (std::size_t k = 0; k < point_count; ++k) {
      const Vec3d point = rings[m][k] + offset;
      const Vec3d previous = rings[m][(k + point_count - 1) % point_count] + offset;
      sink.cone(point, rod_radius, previous, rod_radius);
      sink.sphere(point, rod_radius);
    }
  }
}

/// The wall behind the pyramid fills the view.
void add_wall(int size, double spread, SceneSink& sink) {
  const double y = spread * (size + 1);
  const double reach = 1.01 * (y + spread) * tan_degrees(22.5);
  const double left = -1 - reach, right = -1 + reach, low = 0.5 - reach, high = 0.5 + reach;
  sink.material({.color = {1, 1, 1}, .diffuse = 1, .specular = 0, .shine = no_highlight, .refraction_index = 0});
  sink.polygon({{right, y, high}, {left, y, high}, {left, y, low}, {right, y, low}});
}

}  // namespace

void make_rings(int size, SceneSink& sink) {
  const double spread = 1 / sin_degrees(22.5);
  set_stage(sink, {.from = {-1, -spread, 0.5}, .at = {-1, 1 - spread, 0.5}, .up = {0, 0, 1}, .angle_degrees = 45, .hither = 1},
            {{3, -spread, 3}, {-4, -spread, 1}, {2, -spread, -4}});
  add_wall(size, spread, sink);
  const Rings rings = six_rings();
  for (int d = 0; d < size; ++d) {
    for (int z = 0; z <= d; ++z) {
      for (int x = 0; x <= d; ++x) {
        add_object(rings, {2.0 * x - d, spread * (d + 1), 2.0 * z - d}, sink);
      }
    }
  }
}

}  // namespace dmpc::core::scenes
