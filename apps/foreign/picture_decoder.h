// Pictures by OpenImageIO, from memory.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "apps/picture/image_file.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

struct EncodedPicture {
  std::span<const std::byte> bytes;  ///< the whole file
  std::string name;                  ///< for messages
  std::string format;                ///< OpenImageIO's name (apps/picture/picture_format.h)
  bool keeps_alpha = false;          ///< of a texture, if some of it is not 1
};

/// Makes the library ready, after which it opens nothing and starts no threads.
void prepare_decoders();

/// The finest level alone, as apps/picture/texture_file.h says; edges are left to others. Throws core::InputError "NAME: ...".
core::Texture decode_texture(const EncodedPicture& picture);
/// As apps/picture/image_file.h says. Throws core::InputError "NAME: ...".
Image decode_image(const EncodedPicture& picture);

}  // namespace dmpc::apps
