#include "apps/picture/texture_file.h"

#include "core/scene/texel.h"

namespace dmpc::apps {

void put_below_coat(core::Texture& texture, double coat) {
  if (coat == 0) {
    return;
  }
  for (std::uint32_t& texel : texture.levels.front().texels) {
    const core::Vec3d color(core::decoded(texture.format, texel));
    const core::Vec3d below{below_coat(color.x, coat), below_coat(color.y, coat), below_coat(color.z, coat)};
    texel = core::encoded(texture.format, below, double{core::alpha_of(texture.format, texel)});
  }
}

}  // namespace dmpc::apps
