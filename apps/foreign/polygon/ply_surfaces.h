// The surfaces that faces of a PLY file have: a material of the file's, with a texture of the file's.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/polygon/ply_row.h"

namespace dmpc::apps {

class PlySurfaces {
 public:
  explicit PlySurfaces(std::vector<std::string> textures) : textures_(std::move(textures)) {}

  /// Adds an `element material`. Colours are linear, as MTL's.
  void add_material(const PlyRow& row);
  bool has_materials() const { return !materials_.empty(); }
  std::size_t texture_count() const { return textures_.size(); }

  /// The index, among those of materials(), of the one with these; `texture` may be none.
  std::uint32_t find(std::uint32_t material, std::optional<std::uint32_t> texture);

  /// All that were found, at least one. What has no material is grey, and white where it has a texture or, by `has_colors`,
  /// colours. Throws core::InputError for a material that does not exist.
  std::vector<FileMaterial> materials(bool has_colors);

 private:
  FileMaterial material_of(std::uint32_t material, std::uint32_t texture, bool has_colors) const;

  std::vector<std::string> textures_;
  std::vector<core::Material> materials_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> found_;
};

}  // namespace dmpc::apps
