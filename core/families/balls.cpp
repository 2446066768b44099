// Balls: a sphere with nine smaller ones on it, each with nine on it, and so on.
#include <array>
#include <cmath>

#include "core/families/families.h"
#include "core/families/frame.h"

namespace dmpc::core::scenes {
namespace {

using Directions = std::array<Vec3d, 9>;

/// The directions of the nine children of a ball that points to +z: three tilted by asin(2 / sqrt 6), rotated three times.
Directions child_directions() {
  const double d = 1 / std::sqrt(2.0);
  const std::array<Vec3d, 3> corner = {Vec3d{d, d, 0}, Vec3d{d, 0, -d}, Vec3d{0, d, -d}};
  const Turn tilt = {2 / std::sqrt(6.0), 1 / std::sqrt(3.0)};
  Directions directions;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3d tilted = rotated(corner[i % 3], {d, -d, 0}, tilt);
    directions[i] = rotation_z(turn_degrees(120.0 * static_cast<double>(i / 3))).vector(tilted);
  }
  return directions;
}

/// The shortest rotation from +z to the unit vector `direction`.
Frame frame_towards(const Vec3d& direction) {
  if (direction.z >= 0.9999) {
    return {};
  }
  if (direction.z <= -0.9999) {
    return rotation_y({0, -1});
  }
  const double sine = std::sqrt(1 - direction.z * direction.z);
  return rotation(normalize(cross(Vec3d{0, 0, 1}, direction)), {sine, direction.z});
}

void add_ball(int depth, const Vec3d& center, double radius, const Vec3d& direction, const Directions& directions,
              SceneSink& sink) {
  sink.sphere(center, radius);
  if (depth == 0) {
    return;
  }
  const Frame frame = frame_towards(direction);
  for (const Vec3d& child : directions) {
    const Vec3d outward = frame.vector(child);
    add_ball(depth - 1, center + (radius * 4 / 3) * outward, radius / 3, outward, directions, sink);
  }
}

}  // namespace

void make_balls(int size, SceneSink& sink) {
  set_stage(sink, {.from = {2.1, 1.3, 1.7}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 45, .hither = 0.01},
            {{4, 3, 2}, {1, -4, 4}, {-3, 1, 5}});
  sink.material({.color = {1, 0.75, 0.33}, .diffuse = 0.8, .specular = 0, .shine = no_highlight, .refraction_index = 1});
  floor_square(sink, 12, -0.5);
  sink.material({.color = {1, 0.9, 0.7}, .diffuse = 0.5, .specular = 0.5, .shine = soft_highlight, .refraction_index = 1});
  add_ball(size, {0, 0, 0}, 0.5, {0, 0, 1}, child_directions(), sink);
}

}  // namespace dmpc::core::scenes
