#include "apps/picture/texture_file.h"

#include "apps/picture/picture_reader.h"

namespace dmpc::apps {

core::Texture read_texture(const std::filesystem::path& path, const TextureEdges& edges) {
  return PictureReader().read_texture(open_picture(path), edges);
}

core::Texture read_texture(std::span<const std::byte> file, const std::string& name, const std::string& format_hint,
                           const TextureEdges& edges) {
  return PictureReader().read_texture(picture_of(file, name, format_hint), edges);
}

}  // namespace dmpc::apps
