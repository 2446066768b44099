#include "apps/foreign/mesh/material.h"

#include <assimp/GltfMaterial.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "apps/foreign/mesh/surface.h"

namespace dmpc::apps {
namespace {

using core::Material;
using core::Vec3d;

/// As the macros AI_MATKEY_... spell it out.
struct Key {
  const char* name;
  unsigned type, index;
};

std::optional<double> number(const aiMaterial& source, const Key& key) {
  ai_real value = 0;
  const bool has_one = source.Get(key.name, key.type, key.index, value) == aiReturn_SUCCESS;
  return has_one && std::isfinite(value) ? std::optional(double{value}) : std::nullopt;
}

double share(const aiMaterial& source, const Key& key, double fallback) {
  return std::clamp(number(source, key).value_or(fallback), 0.0, 1.0);
}

std::optional<Vec3d> color(const aiMaterial& source, const Key& key) {
  aiColor3D value;
  if (source.Get(key.name, key.type, key.index, value) != aiReturn_SUCCESS || !is_finite(Vec3d{value.r, value.g, value.b})) {
    return std::nullopt;
  }
  const auto clamped = [](ai_real channel) { return std::clamp(double{channel}, 0.0, 1.0); };
  return Vec3d{clamped(value.r), clamped(value.g), clamped(value.b)};
}

/// Of light, which may be brighter than white.
Vec3d light(const aiMaterial& source, const Key& key) {
  aiColor3D value;
  if (source.Get(key.name, key.type, key.index, value) != aiReturn_SUCCESS || !is_finite(Vec3d{value.r, value.g, value.b})) {
    return {};
  }
  const auto clamped = [](ai_real channel) { return std::clamp(double{channel}, 0.0, light_max); };
  return {clamped(value.r), clamped(value.g), clamped(value.b)};
}

Vec3d emission(const aiMaterial& source) {
  return has_emissive_texture(source) ? Vec3d{} : light(source, {AI_MATKEY_COLOR_EMISSIVE});
}

std::string alpha_mode(const aiMaterial& source) {
  aiString mode;
  return source.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS ? mode.C_Str() : "";
}

double alpha_cutoff(const aiMaterial& source) { return number(source, {AI_MATKEY_GLTF_ALPHACUTOFF}).value_or(0.5); }

/// What a texture's alpha does, by which the material's own is multiplied.
void set_alpha(const aiMaterial& source, Material& material) {
  const double own = share(source, {AI_MATKEY_OPACITY}, 1), cutoff = alpha_cutoff(source);
  const std::string mode = alpha_mode(source);
  if (mode == "BLEND") {
    material.alpha = core::AlphaUse::blend;
  } else if (mode == "MASK" && cutoff > 0 && cutoff <= own) {
    material.alpha = core::AlphaUse::cut;
    material.alpha_cutoff = cutoff / own;
  }
}

Vec3d base_color(const aiMaterial& source) {
  return color(source, {AI_MATKEY_BASE_COLOR}).value_or(Vec3d{1, 1, 1});
}

}  // namespace

Material material_of(const aiMaterial& source) {
  const std::string mode = alpha_mode(source);
  Material material =
      material_of(MetallicSurface{.base = base_color(source),
                                  .emission = emission(source),
                                  .metallic = share(source, {AI_MATKEY_METALLIC_FACTOR}, 0),
                                  .roughness = share(source, {AI_MATKEY_ROUGHNESS_FACTOR}, 1),
                                  .transmission = share(source, {AI_MATKEY_TRANSMISSION_FACTOR}, 0),
                                  .refraction_index = number(source, {AI_MATKEY_REFRACTI}).value_or(1.5),
                                  .opacity = mode.empty() || mode == "BLEND" ? share(source, {AI_MATKEY_OPACITY}, 1) : 1});
  set_alpha(source, material);
  return material;
}

bool is_cut_away(const aiMaterial& source) {
  return alpha_mode(source) == "MASK" && share(source, {AI_MATKEY_OPACITY}, 1) < alpha_cutoff(source);
}

bool says_what_alpha_does(const aiMaterial& source) { return !alpha_mode(source).empty(); }

void list_textures(const aiMaterial& source, std::set<std::string>& names) {
  for (int type = aiTextureType_NONE + 1; type <= AI_TEXTURE_TYPE_MAX; ++type) {
    const auto kind = static_cast<aiTextureType>(type);
    if (kind == aiTextureType_BASE_COLOR) {
      continue;
    }
    for (unsigned i = 0; i < source.GetTextureCount(kind); ++i) {
      aiString name;
      if (source.GetTexture(kind, i, &name) == aiReturn_SUCCESS) {
        names.insert(name.C_Str());
      }
    }
  }
}

bool is_emissive(const aiMaterial& source) { return !(emission(source) == Vec3d{}); }

bool has_emissive_texture(const aiMaterial& source) {
  return source.GetTextureCount(aiTextureType_EMISSIVE) > 0 && !(light(source, {AI_MATKEY_COLOR_EMISSIVE}) == Vec3d{});
}

bool colors_what_shines_through(const aiMaterial& source) {
  const Vec3d base = base_color(source);
  return share(source, {AI_MATKEY_TRANSMISSION_FACTOR}, 0) > 0 &&
         !(base.x == base.y && base.y == base.z);
}

bool has_factor_beyond(const aiMaterial& source) {
  constexpr double rounding = 1e-5;
  const auto is_beyond = [](double value, double most) { return value < -rounding || value > most + rounding; };
  const auto has_color_beyond = [&](const Key& key, double most) {
    aiColor3D color;
    return source.Get(key.name, key.type, key.index, color) == aiReturn_SUCCESS &&
           (is_beyond(double{color.r}, most) || is_beyond(double{color.g}, most) || is_beyond(double{color.b}, most));
  };
  const std::array<Key, 1> colors{{{AI_MATKEY_BASE_COLOR}}};
  const std::array<Key, 4> shares{
      {{AI_MATKEY_OPACITY}, {AI_MATKEY_METALLIC_FACTOR}, {AI_MATKEY_ROUGHNESS_FACTOR}, {AI_MATKEY_TRANSMISSION_FACTOR}}};
  return std::any_of(colors.begin(), colors.end(), [&](const Key& key) { return has_color_beyond(key, 1); }) ||
         std::any_of(shares.begin(), shares.end(),
                     [&](const Key& key) { return is_beyond(number(source, key).value_or(0), 1); }) ||
         has_color_beyond({AI_MATKEY_COLOR_EMISSIVE}, light_max);
}

bool has_clear_coat(const aiMaterial& source) { return share(source, {AI_MATKEY_CLEARCOAT_FACTOR}, 0) > 0; }

}  // namespace dmpc::apps
