#include "apps/foreign/plain_picture.h"

#include "apps/picture/picture_format.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

bool is_plain_size(std::uint64_t width, std::uint64_t height, std::uint64_t value_bytes, std::uint64_t file_bytes,
                   std::uint64_t pixels_max) {
  return width > 0 && height > 0 && width <= core::Texture::size_max && height <= core::Texture::size_max &&
         width * height <= pixels_max && decoded_bytes(width, height, value_bytes) <= decoded_bytes_max(file_bytes);
}

}  // namespace dmpc::apps
