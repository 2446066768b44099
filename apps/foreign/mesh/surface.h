// Converts surfaces from files to ours.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/vec.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Each channel of a surface without a colour.
inline constexpr double plain_grey = 0.6;

/// The brightest emission of a surface, in any channel; placed_scene() scales brighter ones down to it.
inline constexpr double light_max = 1e12;

/// The largest exponent of a highlight; larger ones are clamped.
inline constexpr std::uint32_t shine_max = 10'000;

/// Phong surface as in MTL. Colours are linear, in 0 to 1 except for emission.
struct PhongSurface {
  core::Vec3d diffuse, specular, emission;  ///< Kd, Ks, Ke
  double shine = 0;                         ///< Ns; 0 or less: no highlight
  double refraction_index = 1;              ///< Ni
  double opacity = 1;                       ///< d
  std::optional<int> illumination;          ///< illum, if given: 0 and 1 have no highlight, 3 to 9 mirror
};

/// glTF's surface. Colours are linear, in 0 to 1 except for emission.
struct MetallicSurface {
  core::Vec3d base{1, 1, 1}, emission;
  double metallic = 1, roughness = 1;
  double transmission = 0;
  double refraction_index = 1.5;  ///< 1 or less counts as 1.5
  double opacity = 1;             ///< if blended; otherwise 1
};

/// By the table in apps/foreign/README.md. Energy is conserved in each channel.
core::Material material_of(const PhongSurface& surface);
core::Material material_of(const MetallicSurface& surface);
/// Material of a surface that has at most a colour.
core::Material plain_material(const core::Vec3d& color = {plain_grey, plain_grey, plain_grey});

/// Phong's exponent for glTF's roughness, 0 to 1: half-vector exponent 2 / alpha^2 - 2 with alpha = roughness^2 (B. Walter and
/// others, "Microfacet Models for Refraction through Rough Surfaces", 2007), a quarter of that around the mirror's direction
/// (F. Fisher, A. Woo, "R.E versus N.H Specular Highlights", Graphics Gems IV, 1994); 1 to 10,000.
double shine_of_roughness(double roughness);

}  // namespace dmpc::apps
