// A picture's file, before anybody has looked into it.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "apps/picture/texture_file.h"

namespace dmpc::apps {

struct EncodedPicture {
  std::span<const std::byte> bytes;            ///< the whole file
  std::string name;                            ///< for messages
  std::string format;                          ///< OpenImageIO's name (apps/picture/picture_format.h)
  TextureAlpha alpha = TextureAlpha::ignored;  ///< of a texture, if some of it is not 1
};

}  // namespace dmpc::apps
