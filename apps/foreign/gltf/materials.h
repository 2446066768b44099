// The materials of a glTF document as a file's.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/foreign/gltf/buffers.h"
#include "apps/foreign/mesh/placed_file.h"

namespace dmpc::apps::gltf {

/// What is known of a material beside what is shown of it.
struct MaterialTraits {
  std::optional<std::uint64_t>
      coordinates;                         ///< which of a mesh's texture coordinates its colour's texture lies by, if it has one
  std::set<std::uint64_t> other_textures;  ///< pictures that are not of its colour
  bool shines = false, has_light_texture = false, colors_what_shines_through = false, has_clear_coat = false,
       has_factor_beyond = false;
};

/// Gives the file its materials, and, last, that of primitives without one, with the pictures within the document for which these
/// ask. Notes textures that name no picture. Throws core::InputError, by its place in the document.
std::vector<MaterialTraits> read_materials(const Document& document, Buffers& buffers, SceneTotals& totals, PlacedFile& file);

/// Appends a sentence, with a count, for each kind of thing that `used` materials of the file have and that is not shown.
void note_losses(const std::vector<MaterialTraits>& materials, const std::vector<bool>& used, PlacedFile& file);

}  // namespace dmpc::apps::gltf
