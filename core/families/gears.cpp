// Gears: a block of meshing gears with concave faces, a fifth of them transparent.
#include <algorithm>
#include <vector>

#include "core/families/families.h"
#include "core/families/frame.h"

namespace dmpc::core::scenes {
namespace {

constexpr int tooth_count = 36;
constexpr double outer_share = 0.995, inner_share = 0.9;  // of the radius that just touches the neighbour's

struct Gear {
  Vec3d center;
  double radius = 1, thickness = 0.1, phase_degrees = 0;
};

/// .01 + the fraction of sevenths / 7, in integers so that a multiple of 7 gives exactly 0.
double shade_of(int sevenths) { return 0.01 + static_cast<double>(sevenths % 7) / 7; }

Material gear_material(int x, int y, int z) {
  const Vec3d color = {shade_of(5 * (3 * x + 2 * y + z + 1)), shade_of(3 * (3 * y + 2 * z + x + 1)),
                       shade_of(2 * (3 * z + 2 * x + y + 1))};
  const double most = std::max({color.x, color.y, color.z});
  const Vec3d bright = {color.x / most, color.y / most, color.z / most};
  if ((4 * x + 2 * y + z) % 5 == 0) {
    return {.color = bright, .diffuse = 0.2, .specular = 0, .shine = no_highlight, .transmittance = 0.8, .refraction_index = 1.1};
  }
  return {.color = bright, .diffuse = 1, .specular = 0, .shine = no_highlight, .transmittance = 0, .refraction_index = 0};
}

/// The outline of a face, four points per tooth; `sense` is +1 counter-clockwise from above, -1 clockwise.
std::vector<Vec3d> outline(const Gear& gear, double sense, double lowered) {
  std::vector<Vec3d> points;
  const auto add = [&](double share, double degrees) {
    const double radius = share * gear.radius;
    points.push_back(gear.center + Vec3d{radius * cos_degrees(degrees), radius * sin_degrees(degrees), -lowered});
  };
  const double tooth = sense * 10;
  for (int k = 0; k < tooth_count; ++k) {
    const double angle = gear.phase_degrees + tooth * k;
    add(outer_share, angle - 0.19 * tooth);
    add(outer_share, angle + 0.19 * tooth);
    add(inner_share, angle + 0.3 * tooth);
    add(inner_share, angle + 0.7 * tooth);
  }
  return points;
}

void add_gear(const Gear& gear, SceneSink& sink) {
  const std::vector<Vec3d> top = outline(gear, 1, 0);
  sink.polygon(top);
  const Vec3d down = {0, 0, -gear.thickness};
  for (std::size_t i = 0; i < top.size(); ++i) {
    const Vec3d& next = top[(i + 1) % top.size()];
    sink.polygon({top[i], top[i] + down, next + down, next});
  }
  sink.polygon(outline(gear, -1, gear.thickness));
}

}  // namespace

void make_gears(int size, SceneSink& sink) {
  set_stage(sink, {.from = {-1.1, -2.1, 2.6}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 45, .hither = 1},
            {{2, 4, 4}, {-2, 4, 3}, {2, -2.5, 2.5}, {-1, -4, 2}, {-1.111, -2.121, 2.626}});
  sink.material({.color = {1, 0.85, 0.7}, .diffuse = 0.3, .specular = 0.6, .shine = soft_highlight, .refraction_index = 0});
  floor_square(sink, 2, 0);
  const double radius = 1 / (size - 0.05 * (size - 1));
  const double thickness = std::min(0.1, 1 / (2.0 * size));
  for (int z = 0; z < size; ++z) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        sink.material(gear_material(x, y, z));
        const Vec3d center = {-1 + radius + 1.9 * radius * x, -1 + radius + 1.9 * radius * y, 1 - static_cast<double>(z) / size};
        add_gear({center, radius, thickness, 5.0 * ((x + y + z) % 2)}, sink);
      }
    }
  }
}

}  // namespace dmpc::core::scenes
