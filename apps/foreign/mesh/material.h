// A material of Assimp's as one of ours.
#pragma once

#include <assimp/material.h>

#include <set>
#include <string>

#include "core/scene/scene.h"

namespace dmpc::apps {

/// What each channel of a surface has of which a file says no colour.
inline constexpr double plain_grey = 0.6;

/// By the table in apps/foreign/README.md. Colours are linear. Reflects and transmits no more light than arrives, in any channel.
core::Material material_of(const aiMaterial& source);

/// The names of its textures that are not looked at: all but those of its colour (apps/foreign/mesh/textures.h).
void list_textures(const aiMaterial& source, std::set<std::string>& names);

bool is_emissive(const aiMaterial& source);
/// glTF's alpha mode MASK.
bool has_alpha_mask(const aiMaterial& source);
bool has_clear_coat(const aiMaterial& source);
/// Whether the coordinates of its colour's texture are to be transformed, of which glTF's alone are
/// (apps/foreign/mesh/texture_place.h).
bool has_moved_texture(const aiMaterial& source);

}  // namespace dmpc::apps
