#include "apps/foreign/mesh/surface.h"

#include <algorithm>

namespace dmpc::apps {
namespace {

using core::Material;
using core::Vec3d;

double mean(const Vec3d& v) { return (v.x + v.y + v.z) / 3; }

/// What a dielectric reflects straight ahead (Fresnel).
double straight_reflection(double index) {
  const double root = (index - 1) / (index + 1);
  return root * root;
}

/// The surface covers only `opacity` of what is behind it.
void cover(Material& material, double opacity) {
  material.diffuse *= opacity;
  material.specular *= opacity;
  material.tinted_specular *= opacity;
  material.emission = material.emission * opacity;
  material.transmittance = material.transmittance * opacity + (1 - opacity);
}

/// Highlight and mirror of this colour: where it is grey, without a tint.
void set_specular(Material& material, const Vec3d& color) {
  const bool is_grey = color.x == color.y && color.y == color.z;
  material.specular = is_grey ? mean(color) : largest_component(color);
  material.specular_color =
      is_grey ? Vec3d{1, 1, 1} : Vec3d{color.x / material.specular, color.y / material.specular, color.z / material.specular};
}

}  // namespace

double shine_of_roughness(double roughness) {
  const double alpha = roughness * roughness;
  return alpha * alpha * shine_max > 0.5 ? std::clamp<double>((2 / (alpha * alpha) - 2) / 4, 1, shine_max) : shine_max;
}

Material material_of(const PhongSurface& surface) {
  constexpr double sharp = 1000;
  const int illumination = surface.illumination.value_or(2);
  const bool mirrors = illumination >= 3 && illumination <= 9;
  Material material;
  material.color = surface.diffuse;
  material.shine = surface.shine > 0 ? std::min<double>(surface.shine, shine_max) : sharp;
  material.refraction_index = surface.refraction_index > 0 ? surface.refraction_index : 1;
  material.emission = surface.emission;
  if (mirrors || (illumination >= 2 && surface.shine > 0)) {
    set_specular(material, surface.specular);
  }
  if (mirrors) {
    material.diffuse = 1 / std::max(largest_component(surface.diffuse + surface.specular), 1.0);
    material.specular *= material.diffuse;
  } else if (material.specular > 0) {
    material.mirror = 0;
  }
  cover(material, surface.opacity);
  return material;
}

Material plain_material(const Vec3d& color) { return material_of(PhongSurface{.diffuse = color}); }

Material material_of(const MetallicSurface& surface) {
  const double index = surface.refraction_index > 1 ? surface.refraction_index : 1.5;
  const double smooth = 1 - surface.roughness, transmission = surface.transmission * (1 - surface.metallic);
  Material material;
  material.color = surface.base;
  material.specular = smooth * (1 - surface.metallic) * straight_reflection(index);
  material.tinted_specular = smooth * surface.metallic;
  material.shine = shine_of_roughness(surface.roughness);
  const double rest = 1 - material.specular - material.tinted_specular;
  material.diffuse = rest * (1 - transmission);
  material.transmittance = rest * transmission * mean(surface.base);
  material.refraction_index = transmission > 0 ? index : 1;
  material.emission = surface.emission;
  cover(material, surface.opacity);
  material.microfacets = {.roughness = surface.roughness,
                          .metallic = surface.metallic,
                          .reflectance = straight_reflection(index),
                          .transmission = surface.transmission,
                          .opacity = surface.opacity};
  return material;
}

}  // namespace dmpc::apps
