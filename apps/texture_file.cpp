#include "apps/texture_file.h"

#include "apps/reader/picture_reader.h"
#include "core/expect.h"

namespace dmpc::apps {

void check_texture_size(const std::string& name, std::int64_t width, std::int64_t height) {
  constexpr std::int64_t most = core::Texture::size_max;
  if (width < 1 || height < 1 || width > most || height > most) {
    throw core::InputError(name + ": a texture of " + std::to_string(width) + "x" + std::to_string(height) +
                           " texels; expected 1 to " + std::to_string(most) + " along a side");
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
