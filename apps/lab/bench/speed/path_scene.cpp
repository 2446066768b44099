#include "apps/lab/bench/speed/path_scene.h"

#include "core/base/vec.h"
#include "core/database/conversion.h"
#include "core/database/light_spheres.h"
#include "core/database/parallel.h"

namespace dmpc::apps {

namespace {

constexpr double light_share = 0.05, roughness = 0.3;

void polish(core::Material& material) {
  const double mirrored = material.specular_max() * material.mirror;
  if (mirrored > 0 && !material.microfacets.are_there()) {
    material.microfacets = {.roughness = roughness, .metallic = mirrored / (mirrored + material.diffuse)};
  }
}

}  // namespace

void light_and_polish(core::Scene& scene) {
  for (core::Material& material : scene.materials) {
    polish(material);
  }
  const core::Box box = core::bounds_of(scene, core::Parallel(1));
  if (!box.empty()) {
    core::make_lights_spheres(scene, light_share * 2 * length(box.half()));
  }
}

}  // namespace dmpc::apps
