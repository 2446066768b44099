// A material of Assimp's as one of ours.
#pragma once

#include <assimp/material.h>

#include <set>
#include <string>

#include "core/scene/scene.h"

namespace dmpc::apps {

/// By apps/foreign/mesh/surface.h. Its alpha is what that of a texture or of vertices' colours would do (core::Material::alpha).
core::Material material_of(const aiMaterial& source);
/// Whether nothing of the surface is there: its mode is MASK, and its alpha below the cutoff, whatever a texture's.
bool is_cut_away(const aiMaterial& source);
/// Whether it has a mode of alpha, by which that of its texture counts, or does not.
bool says_what_alpha_does(const aiMaterial& source);

/// The names of its textures that are not looked at: all but those of its colour (apps/foreign/mesh/textures.h).
void list_textures(const aiMaterial& source, std::set<std::string>& names);

bool is_emissive(const aiMaterial& source);
/// It says what it emits by a texture, which is not looked at; it is no emissive material then.
bool has_emissive_texture(const aiMaterial& source);
/// glTF's transmission through a base colour that is not grey: ours lets all colours through alike.
bool colors_what_shines_through(const aiMaterial& source);
bool has_clear_coat(const aiMaterial& source);
/// Whether a colour or a share lies outside 0 to 1, or light or an exponent below 0: material_of() brings them into it.
bool has_factor_beyond(const aiMaterial& source);

}  // namespace dmpc::apps
