// MTL files as Assimp can read them: it loses textures behind some options, and leaves others out.
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

/// The file with each texture's name alone, but for -clamp; adds to `textures` what was said before the names.
std::string plain_mtl(std::string_view file, MtlTextures& textures);

}  // namespace dmpc::apps
