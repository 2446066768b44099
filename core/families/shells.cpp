// Shells: a sea shell of spheres along a logarithmic spiral, most of them tiny, all overlapping; the pathological case.
#include <numbers>

#include "core/base/elementary.h"
#include "core/families/families.h"

namespace dmpc::core::scenes {

void make_shells(int size, SceneSink& sink) {
  set_stage(sink, {.from = {-6, -60, 35}, .at = {0, 8, -15}, .up = {0, 0, 1}, .angle_degrees = 45, .hither = 0.5},
            {{-100, -100, 100}});
  sink.material({.color = {1, 0.8, 0.4}, .diffuse = 0.8, .specular = 0.2, .shine = 45.2776, .refraction_index = 1});
  const int steps = 180 << static_cast<unsigned>(size);
  for (int i = -2 * (steps / 3); i <= steps / 3; ++i) {
    const double angle = 18 * std::numbers::pi * i / steps;
    const double radius = exponential(0.15 * angle);
    sink.sphere({radius * sin_radians(angle), radius * cos_radians(angle), -2 * radius}, radius);
  }
}

}  // namespace dmpc::core::scenes
