#include "apps/foreign/polygon/plain_material.h"

#include "apps/foreign/mesh/material.h"

namespace dmpc::apps {

core::Material plain_material(const core::Vec3d& color) {
  core::Material material = plain_material();
  material.color = color;
  return material;
}

core::Material plain_material() { return material_of(aiMaterial{}); }

}  // namespace dmpc::apps
