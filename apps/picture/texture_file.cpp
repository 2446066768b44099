#include "apps/picture/texture_file.h"

#include "apps/picture/picture_reader.h"
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

core::Texture read_texture(const std::filesystem::path& path, const TextureEdges& edges) {
  return PictureReader().read_texture(open_picture(path), edges);
}

core::Texture read_texture(std::span<const std::byte> file, const std::string& name, const std::string& format_hint,
                           const TextureEdges& edges) {
  return PictureReader().read_texture(picture_of(file, name, format_hint), edges);
}

}  // namespace dmpc::apps
