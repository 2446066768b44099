// MTL files as Assimp can read them: it loses textures behind some options, leaves others out, and passes over those without a
// name without a word.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "apps/foreign/mesh/texture_place.h"

namespace dmpc::apps {

/// What the options of textures say, of one file or several.
struct MtlTextures {
  std::map<std::string, TexturePlace> places;     ///< -s and -o of each material's colour texture (map_Kd)
  std::map<std::string, std::uint64_t> left_out;  ///< other options of these that change the picture, and how often
};

/// A file of materials as Assimp gets it.
struct PlainMtl {
  std::string text;  ///< each texture's name alone, but for -clamp
  std::string note;  ///< a sentence about textures of colour (map_Kd) without a name and how many there are, or nothing
};

/// Adds to `textures` what was said before the names. Throws core::InputError "PATH ..." for a texture of colour whose name, with
/// its options, is too long for Assimp. A line ends with \n, \r\n or \r.
PlainMtl plain_mtl(const std::string& path, std::string_view file, MtlTextures& textures);

}  // namespace dmpc::apps
