#include "apps/foreign/mesh/material.h"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>

#include <algorithm>
#include <cmath>
#include <optional>

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

double mean(const Vec3d& v) { return (v.x + v.y + v.z) / 3; }

/// What a dielectric reflects straight ahead (Fresnel); an index that says nothing counts as glass, 1.5.
double straight_reflection(double index) {
  const double glass = index > 1 ? index : 1.5;
  const double root = (glass - 1) / (glass + 1);
  return root * root;
}

std::string alpha_mode(const aiMaterial& source) {
  aiString mode;
  return source.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS ? mode.C_Str() : "";
}

/// The surface covers only `opacity` of what is behind it.
void cover(Material& material, double opacity) {
  material.diffuse *= opacity;
  material.specular *= opacity;
  material.transmittance = material.transmittance * opacity + (1 - opacity);
}

bool is_metallic_roughness(const aiMaterial& source) {
  return number(source, {AI_MATKEY_METALLIC_FACTOR}) || number(source, {AI_MATKEY_ROUGHNESS_FACTOR});
}

Material from_metallic_roughness(const aiMaterial& source) {
  const Vec3d base =
      color(source, {AI_MATKEY_BASE_COLOR}).value_or(color(source, {AI_MATKEY_COLOR_DIFFUSE}).value_or(Vec3d{1, 1, 1}));
  const double roughness = share(source, {AI_MATKEY_ROUGHNESS_FACTOR}, 1);
  const double metallic = share(source, {AI_MATKEY_METALLIC_FACTOR}, 0);
  const double transmission = share(source, {AI_MATKEY_TRANSMISSION_FACTOR}, 0) * (1 - metallic);
  const double index = number(source, {AI_MATKEY_REFRACTI}).value_or(1.5);
  Material material;
  material.color = base;
  material.specular = (1 - roughness) * (metallic * mean(base) + (1 - metallic) * straight_reflection(index));
  material.shine = shine_of_roughness(roughness);
  material.diffuse = (1 - material.specular) * (1 - transmission);
  material.transmittance = (1 - material.specular) * transmission * mean(base);
  material.refraction_index = transmission > 0 ? (index > 1 ? index : 1.5) : 1;
  const std::string mode = alpha_mode(source);
  cover(material, mode.empty() || mode == "BLEND" ? share(source, {AI_MATKEY_OPACITY}, 1) : 1);
  return material;
}

/// Ks as far as our surfaces can stand for it: highlight and mirror are one for them.
double phong_specular(const aiMaterial& source, double shine, double index) {
  int illumination = 2;
  source.Get(AI_MATKEY_OBJ_ILLUM, illumination);
  const Vec3d specular = color(source, {AI_MATKEY_COLOR_SPECULAR}).value_or(Vec3d{});
  const double weight = mean(specular) * share(source, {AI_MATKEY_SHININESS_STRENGTH}, 1);
  if (illumination >= 3 && illumination <= 9) {
    return weight;
  }
  return illumination == 2 && shine > 0 ? std::min(weight, straight_reflection(index)) : 0;
}

Material from_phong(const aiMaterial& source) {
  constexpr double sharp = 1000;
  const double index = number(source, {AI_MATKEY_REFRACTI}).value_or(1);
  const double shine = number(source, {AI_MATKEY_SHININESS}).value_or(0);
  Material material;
  material.color = color(source, {AI_MATKEY_COLOR_DIFFUSE}).value_or(Vec3d{plain_grey, plain_grey, plain_grey});
  material.specular = phong_specular(source, shine, index);
  material.shine = shine > 0 ? std::min(shine, 10'000.0) : sharp;
  const double sum = std::max({material.color.x, material.color.y, material.color.z}) + material.specular;
  material.diffuse = 1 / std::max(sum, 1.0);
  material.specular *= material.diffuse;
  material.refraction_index = index > 0 ? index : 1;
  cover(material, share(source, {AI_MATKEY_OPACITY}, 1));
  return material;
}

}  // namespace

double shine_of_roughness(double roughness) {
  constexpr double most = 10'000;
  const double alpha = roughness * roughness;
  return alpha * alpha * most > 0.5 ? std::clamp((2 / (alpha * alpha) - 2) / 4, 1.0, most) : most;
}

Material material_of(const aiMaterial& source) {
  return is_metallic_roughness(source) ? from_metallic_roughness(source) : from_phong(source);
}

void list_textures(const aiMaterial& source, std::set<std::string>& names) {
  for (int type = aiTextureType_NONE + 1; type <= AI_TEXTURE_TYPE_MAX; ++type) {
    const auto kind = static_cast<aiTextureType>(type);
    if (kind == aiTextureType_BASE_COLOR || kind == aiTextureType_DIFFUSE) {
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

bool is_emissive(const aiMaterial& source) { return color(source, {AI_MATKEY_COLOR_EMISSIVE}).value_or(Vec3d{}) != Vec3d{}; }

bool has_alpha_mask(const aiMaterial& source) { return alpha_mode(source) == "MASK"; }

bool has_moved_texture(const aiMaterial& source) {
  const auto is_moved = [&](aiTextureType type) {
    aiUVTransform transform;
    const bool has_one = source.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS;
    return has_one && (transform.mTranslation != aiVector2D(0, 0) || transform.mScaling != aiVector2D(1, 1) ||
                       transform.mRotation < 0 || transform.mRotation > 0);
  };
  return is_moved(aiTextureType_BASE_COLOR) || is_moved(aiTextureType_DIFFUSE);
}

bool has_clear_coat(const aiMaterial& source) { return share(source, {AI_MATKEY_CLEARCOAT_FACTOR}, 0) > 0; }

}  // namespace dmpc::apps
