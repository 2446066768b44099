#include "core/database/shading/light_spheres.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/box.h"
#include "core/database/conversion.h"
#include "core/database/parallel.h"

namespace dmpc::core {

std::uint64_t make_lights_spheres(Scene& scene, double radius) {
  const Box box = bounds_of(scene, Parallel(1));
  if (box.empty()) {
    return scene.lights.size();
  }
  const double diagonal = 2.0 * length(box.half());
  std::vector<std::pair<PointLight, Vec3d>> spheres;  // with their emission
  std::vector<PointLight> points;
  for (const PointLight& light : scene.lights) {
    const Vec3d intensity = intensity_of(light, scene);
    const double distance = length(light.position - box.center());
    const bool is_cone = light.cone.none_degrees > 0;
    if (is_cone || radius < small_light_share * diagonal || length(light.position - scene.view.from) <= radius ||
        distance > far_light_diagonals * diagonal) {
      points.push_back(light);
      points.back().color = intensity;  // keeps its relative intensity
      points.back().has_color = true;
      continue;
    }
    const double ratio = light.falls_off_from > 0 ? 1.0 / radius : std::max(distance / radius, 1.0);
    spheres.emplace_back(light, intensity * (ratio * ratio));
  }
  scene.lights = std::move(points);
  SceneBuilder builder(scene);
  for (const auto& [light, radiance] : spheres) {
    builder.material({.color = {0, 0, 0}, .diffuse = 0, .emission = radiance});
    builder.sphere(light.position, radius);
  }
  return scene.lights.size();
}

}  // namespace dmpc::core
