#include "apps/foreign/mesh/surface.h"

#include <algorithm>

namespace dmpc::apps {
namespace {

using core::Material;
using core::Vec3d;

constexpr double shine_max = 10'000;

double mean(const Vec3d& v) { return (v.x + v.y + v.z) / 3; }

/// What a dielectric reflects straight ahead (Fresnel); an index that says nothing counts as glass, 1.5.
double straight_reflection(double index) {
  const double glass = index > 1 ? index : 1.5;
  const double root = (glass - 1) / (glass + 1);
  return root * root;
}

/// The surface covers only `opacity` of what is behind it.
void cover(Material& material, double opacity) {
  material.diffuse *= opacity;
  material.specular *= opacity;
  material.transmittance = material.transmittance * opacity + (1 - opacity);
}

/// Ks as far as our surfaces can stand for it: highlight and mirror are one for them.
double phong_specular(const PhongSurface& surface) {
  const int illumination = surface.illumination.value_or(2);
  const double weight = mean(surface.specular);
  if (illumination >= 3 && illumination <= 9) {
    return weight;
  }
  return illumination == 2 && surface.shine > 0 ? std::min(weight, straight_reflection(surface.refraction_index)) : 0;
}

}  // namespace

double shine_of_roughness(double roughness) {
  const double alpha = roughness * roughness;
  return alpha * alpha * shine_max > 0.5 ? std::clamp((2 / (alpha * alpha) - 2) / 4, 1.0, shine_max) : shine_max;
}

Material material_of(const PhongSurface& surface) {
  constexpr double sharp = 1000;
  Material material;
  material.color = surface.diffuse;
  material.specular = phong_specular(surface);
  material.shine = surface.shine > 0 ? std::min(surface.shine, shine_max) : sharp;
  const double sum = std::max({material.color.x, material.color.y, material.color.z}) + material.specular;
  material.diffuse = 1 / std::max(sum, 1.0);
  material.specular *= material.diffuse;
  material.refraction_index = surface.refraction_index > 0 ? surface.refraction_index : 1;
  cover(material, surface.opacity);
  return material;
}

Material material_of(const MetallicSurface& surface) {
  const double transmission = surface.transmission * (1 - surface.metallic), index = surface.refraction_index;
  Material material;
  material.color = surface.base;
  material.specular =
      (1 - surface.roughness) * (surface.metallic * mean(surface.base) + (1 - surface.metallic) * straight_reflection(index));
  material.shine = shine_of_roughness(surface.roughness);
  material.diffuse = (1 - material.specular) * (1 - transmission);
  material.transmittance = (1 - material.specular) * transmission * mean(surface.base);
  material.refraction_index = transmission > 0 ? (index > 1 ? index : 1.5) : 1;
  cover(material, surface.opacity);
  return material;
}

}  // namespace dmpc::apps
