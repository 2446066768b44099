// Pictures by OpenImageIO, from memory.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "apps/picture/image_file.h"
#include "apps/picture/texture_file.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

struct EncodedPicture {
  std::span<const std::byte> bytes;            ///< the whole file
  std::string name;                            ///< for messages
  std::string format;                          ///< OpenImageIO's name (apps/picture/picture_format.h)
  TextureAlpha alpha = TextureAlpha::ignored;  ///< of a texture, if some of it is not 1
};

/// Makes the library ready, after which it opens nothing and starts no threads.
void prepare_decoders();

/// The finest level alone, as apps/picture/texture_file.h says; edges are left to others. Throws core::InputError "NAME: ...".
core::Texture decode_texture(const EncodedPicture& picture);
/// Whether some of its alpha is not 1. Throws core::InputError "NAME: ...".
bool has_alpha(const EncodedPicture& picture);
/// As apps/picture/image_file.h says. Throws core::InputError "NAME: ...".
Image decode_image(const EncodedPicture& picture);

}  // namespace dmpc::apps
