#include "apps/picture/texture_size.h"

#include "core/base/expect.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

void check_texture_size(const std::string& name, std::int64_t width, std::int64_t height) {
  constexpr std::int64_t most = core::Texture::size_max;
  if (width < 1 || height < 1 || width > most || height > most) {
    throw core::InputError(name + ": a texture of " + std::to_string(width) + "x" + std::to_string(height) +
                           " texels; expected 1 to " + std::to_string(most) + " along a side");
  }
}

}  // namespace dmpc::apps
