#include "apps/foreign/polygon/ply_surfaces.h"

#include <limits>

#include "apps/foreign/mesh/material.h"
#include "apps/foreign/mesh/surface.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t without_texture = std::numeric_limits<std::uint32_t>::max();

/// 0 to 1, of the type's largest number; that of an integer of more than 16 bits is 255.
double share_of(const PlyRow& row, PlyRole role) {
  constexpr double byte_max = 255;
  const PlyType type = row.type_of(role);
  const double most = !is_whole(type) ? 1 : type == PlyType::uint16 ? most_of(type) : byte_max;
  return row[role] / most;
}

aiColor3D material_color(const PlyRow& row, PlyRole red, PlyRole green, PlyRole blue) {
  const auto channel = [&row](PlyRole role) { return row.has(role) ? static_cast<ai_real>(share_of(row, role)) : 0; };
  return {channel(red), channel(green), channel(blue)};
}

}  // namespace

void PlySurfaces::add_material(const PlyRow& row) {
  using enum PlyRole;
  aiMaterial source;
  const aiColor3D diffuse = material_color(row, red, green, blue),
                  specular = material_color(row, specular_red, specular_green, specular_blue);
  source.AddProperty(&diffuse, 1, AI_MATKEY_COLOR_DIFFUSE);
  source.AddProperty(&specular, 1, AI_MATKEY_COLOR_SPECULAR);
  if (row.has(shine)) {
    const auto power = static_cast<ai_real>(row[shine]);
    source.AddProperty(&power, 1, AI_MATKEY_SHININESS);
  }
  if (row.has(opacity)) {
    const auto share = static_cast<ai_real>(share_of(row, opacity));
    source.AddProperty(&share, 1, AI_MATKEY_OPACITY);
  }
  materials_.push_back(apps::material_of(source));
}

std::uint32_t PlySurfaces::find(std::uint32_t material, std::optional<std::uint32_t> texture) {
  const auto next = static_cast<std::uint32_t>(found_.size());
  return found_.try_emplace({material, texture.value_or(without_texture)}, next).first->second;
}

FileMaterial PlySurfaces::material_of(std::uint32_t material, std::uint32_t texture, bool has_colors) const {
  FileMaterial result;
  if (materials_.empty()) {
    result.material = texture != without_texture || has_colors ? plain_material({1, 1, 1}) : plain_material();
  } else if (material < materials_.size()) {
    result.material = materials_[material];
  } else {
    throw core::InputError("a face has material " + std::to_string(material) + ", which does not exist: there are " +
                           std::to_string(materials_.size()) + "; correct the file");
  }
  if (texture != without_texture) {
    result.texture = TextureUse{.path = textures_.at(texture)};
  }
  return result;
}

std::vector<FileMaterial> PlySurfaces::materials(bool has_colors) {
  find(0, std::nullopt);
  std::vector<FileMaterial> result(found_.size());
  for (const auto& [kind, number] : found_) {
    result[number] = material_of(kind.first, kind.second, has_colors);
  }
  return result;
}

}  // namespace dmpc::apps
