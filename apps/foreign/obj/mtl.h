// Material libraries (MTL files) of OBJ files.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/obj/texture_words.h"
#include "core/base/vec.h"
#include "core/scene/scene.h"

namespace dmpc::apps::obj {

/// The statements of a material; absent statements have no value. Colours are linear.
struct MtlMaterial {
  std::string name;                           ///< with blanks and any apparent comment
  std::optional<core::Vec3d> diffuse;         ///< Kd
  core::Vec3d specular, emission;             ///< Ks, Ke
  std::optional<core::Vec3d> filter;          ///< Tf
  double shine = 0, refraction_index = 1;     ///< Ns, Ni
  std::optional<double> d, transparency;      ///< d and Tr, which is 1 - d
  std::optional<int> illumination;            ///< illum
  std::optional<double> roughness, metallic;  ///< Pr, Pm
  bool has_halo = false;                      ///< d -halo
  bool has_clear_coat = false;                ///< Pc
  bool has_other_colors = false;              ///< given as spectral curves or CIE XYZ
  std::optional<TextureWords> texture;        ///< map_Kd
  bool has_light_texture = false;             ///< map_Ke
  std::set<std::string> other_textures;       ///< statements of textures other than of the diffuse colour
};

/// Returns whether the material has a specular colour but no exponent; without an exponent no highlight is shown.
bool lacks_exponent(const MtlMaterial& material);
/// Returns the opacity, 0 to 1, from d, which takes precedence over Tr.
double opacity_of(const MtlMaterial& material);
bool contradicts_itself(const MtlMaterial& material);
/// Returns the emitted radiance; zero if a texture defines it.
core::Vec3d emission_of(const MtlMaterial& material);
/// Converts the material by the table in apps/foreign/README.md.
core::Material shown_material(const MtlMaterial& material);

/// Passes each material of a file to `take`, in order, and notes statements without meaning. Throws core::InputError, with the
/// line, for an invalid value, or for a statement before the first newmtl.
void parse_mtl(std::string_view file, const std::function<void(MtlMaterial)>& take, std::vector<std::string>& notes);

}  // namespace dmpc::apps::obj
