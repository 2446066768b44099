#include "apps/foreign/polygon/ply_surfaces.h"

#include <algorithm>
#include <limits>

#include "apps/foreign/mesh/surface.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t without_texture = std::numeric_limits<std::uint32_t>::max();

/// Returns 0 to 1, relative to the type's largest number, or to 255 for integers of more than 16 bits.
double share_of(const PlyRow& row, PlyRole role) {
  constexpr double byte_max = 255;
  const PlyType type = row.type_of(role);
  const double most = !is_whole(type) ? 1 : type == PlyType::uint16 ? most_of(type) : byte_max;
  return row[role] / most;
}

core::Vec3d color_of(const PlyRow& row, PlyRole red, PlyRole green, PlyRole blue) {
  const auto channel = [&row](PlyRole role) { return row.has(role) ? std::clamp(share_of(row, role), 0.0, 1.0) : 0; };
  return {channel(red), channel(green), channel(blue)};
}

}  // namespace

void PlySurfaces::add_material(const PlyRow& row) {
  using enum PlyRole;
  materials_.push_back(
      apps::material_of(PhongSurface{.diffuse = color_of(row, red, green, blue),
                                     .specular = color_of(row, specular_red, specular_green, specular_blue),
                                     .shine = row.has(shine) ? row[shine] : 0,
                                     .refraction_index = 1,
                                     .opacity = row.has(opacity) ? std::clamp(share_of(row, opacity), 0.0, 1.0) : 1,
                                     .illumination = std::nullopt}));
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
