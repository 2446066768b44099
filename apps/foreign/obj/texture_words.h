// What an MTL file says of a texture: options, then a file's name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/mesh/texture_place.h"
#include "apps/picture/texture_file.h"

namespace dmpc::apps::obj {

struct TextureWords {
  std::string name;                   ///< with blanks, and what looks like a remark
  TexturePlace place;                 ///< by -s and -o
  TextureEdges edges;                 ///< by -clamp
  std::vector<std::string> left_out;  ///< other options, "-mm", that change the picture
};

/// Parses the text after the keyword. The last word is the file name, even if it looks like an option.
TextureWords texture_words(std::string_view text);

}  // namespace dmpc::apps::obj
