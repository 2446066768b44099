// A texture statement of an MTL file: options, then a file name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/mesh/texture_place.h"
#include "apps/picture/texture_file.h"

namespace dmpc::apps::obj {

struct TextureWords {
  std::string name;                   ///< with blanks and any apparent comment
  TexturePlace place;                 ///< from -s and -o
  TextureEdges edges;                 ///< from -clamp
  std::vector<std::string> left_out;  ///< ignored options that change the picture, such as "-mm"
};

/// Parses the text after the keyword. The last word is the file name, even if it looks like an option.
TextureWords texture_words(std::string_view text);

}  // namespace dmpc::apps::obj
