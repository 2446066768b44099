// The program dmpc_picture_reader: decodes pictures for dmpc, which starts it.

#include <memory>
#include <span>
#include <string>

#include "apps/foreign/mapped_file.h"
#include "apps/foreign/picture_decoder.h"
#include "apps/foreign/service.h"

namespace dmpc::apps {
namespace {

void send_head(std::uint32_t width, std::uint32_t height, core::TexelFormat format, bool hides_alpha, Line& line) {
  line.send(Saying::picture, Packer().add(width).add(height).add(format).add(static_cast<std::uint8_t>(hides_alpha)));
}

void serve_picture(const Message& request, Line& line) {
  Unpacker fields(request.bytes);
  const std::string name = fields.take_text(), format = fields.take_text();
  const std::unique_ptr<FileBytes> file = map_file(request.file, fields.take<std::uint64_t>());
  const EncodedPicture picture{file->bytes(), name, format, fields.take_choice(TextureAlpha::kept)};
  if (request.saying == Saying::read_texture) {
    const core::Texture texture = decode_texture(picture);
    const core::TextureLevel& finest = texture.levels.front();
    const bool hides_alpha = picture.alpha == TextureAlpha::said && has_alpha(picture);
    send_head(finest.width, finest.height, texture.format, hides_alpha, line);
    send_bytes(std::as_bytes(std::span(finest.texels)), line);
  } else {
    const Image image = decode_image(picture);
    send_head(static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), core::TexelFormat::srgb, false,
              line);
    send_bytes(std::as_bytes(std::span(image.rgb)), line);
  }
  line.send(Saying::done);
}

}  // namespace
}  // namespace dmpc::apps

int main() {
  dmpc::apps::prepare_decoders();
  dmpc::apps::serve_requests(dmpc::apps::serve_picture);
}
