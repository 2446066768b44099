// The surfaces of PLY faces: combinations of the file's materials and textures.
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

  /// Adds an `element material`. Colours are linear, as in MTL files.
  void add_material(const PlyRow& row);
  std::size_t texture_count() const { return textures_.size(); }

  /// Returns the index within materials() of this combination; `texture` may be empty.
  std::uint32_t find(std::uint32_t material, std::optional<std::uint32_t> texture);

  /// Returns all combinations that find() returned, at least one. Faces without a material are grey, or white if they have a
  /// texture or, with `has_colors`, colours. Throws core::InputError for an undefined material.
  std::vector<FileMaterial> materials(bool has_colors);

 private:
  FileMaterial material_of(std::uint32_t material, std::uint32_t texture, bool has_colors) const;

  std::vector<std::string> textures_;
  std::vector<core::Material> materials_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> found_;
};

}  // namespace dmpc::apps
