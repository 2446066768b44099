// Files of materials that OBJ files name.
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

/// What a material says, and nothing that it does not say. Colours are linear.
struct MtlMaterial {
  std::string name;                           ///< with blanks, and what looks like a remark
  std::optional<core::Vec3d> diffuse;         ///< Kd
  core::Vec3d specular, emission;             ///< Ks, Ke
  std::optional<core::Vec3d> filter;          ///< Tf
  double shine = 0, refraction_index = 1;     ///< Ns, Ni
  std::optional<double> d, transparency;      ///< d and Tr, which is 1 - d
  std::optional<int> illumination;            ///< illum
  std::optional<double> roughness, metallic;  ///< Pr, Pm
  bool has_halo = false;                      ///< d -halo
  bool has_clear_coat = false;                ///< Pc
  bool has_other_colors = false;              ///< by spectral curves, or CIE XYZ
  std::optional<TextureWords> texture;        ///< map_Kd
  bool has_light_texture = false;             ///< map_Ke
  std::set<std::string> other_textures;       ///< names of those that are not of its colour
};

/// Whether it names a colour of its highlight, and no exponent without which none is shown.
bool lacks_exponent(const MtlMaterial& material);
/// By d, which what Tr says otherwise does not change; 0 to 1.
double opacity_of(const MtlMaterial& material);
bool contradicts_itself(const MtlMaterial& material);
/// What it shines with by itself; nothing where a texture says how much.
core::Vec3d emission_of(const MtlMaterial& material);
/// By the table in apps/foreign/README.md.
core::Material shown_material(const MtlMaterial& material);

/// Hands over each material of a file, in order, and adds to `notes` what of the file has no meaning. Throws core::InputError,
/// with the line, for a value that is none, or a statement of a material before any is named.
void parse_mtl(std::string_view file, const std::function<void(MtlMaterial)>& take, std::vector<std::string>& notes);

}  // namespace dmpc::apps::obj
