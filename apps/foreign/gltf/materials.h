// Converts the materials of a glTF document.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "apps/foreign/gltf/buffers.h"
#include "apps/foreign/mesh/placed_file.h"

namespace dmpc::apps::gltf {

/// Properties of a material that are not in its FileMaterial.
struct MaterialTraits {
  std::optional<std::uint64_t> coordinates;  ///< set of texture coordinates of the colour texture, if there is one
  std::set<std::uint64_t> other_textures;    ///< pictures for other properties than its colour
  bool has_light_texture = false, colors_what_shines_through = false, has_clear_coat = false, has_factor_beyond = false;
};

/// Adds the materials to the file, the last one for primitives without a material, and the embedded pictures that they need.
/// Notes textures without a picture. Throws core::InputError, with the place in the document.
std::vector<MaterialTraits> read_materials(const Document& document, Buffers& buffers, SceneTotals& totals, PlacedFile& file);

/// Appends a sentence, with a count, for each feature of the file's `used` materials that is not shown.
void note_losses(const std::vector<MaterialTraits>& materials, const std::vector<bool>& used, PlacedFile& file);

}  // namespace dmpc::apps::gltf
