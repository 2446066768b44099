#include "apps/foreign/picture_service.h"

#include <cstdint>
#include <span>
#include <string>

#include "apps/foreign/mapped_file.h"
#include "apps/foreign/service.h"

namespace dmpc::apps {
namespace {

void send_head(std::uint32_t width, std::uint32_t height, core::TexelFormat format, bool hides_alpha, Line& line) {
  line.send(Saying::picture, Packer().add(width).add(height).add(format).add_flag(hides_alpha));
}

void send_texture(const OpenedPicture& opened, const EncodedPicture& picture, Line& line) {
  const core::Texture texture = texture_of(opened, picture);
  const core::TextureLevel& finest = texture.levels.front();
  const bool hides_alpha = picture.alpha == TextureAlpha::said && !opened.alpha().empty();
  send_head(finest.width, finest.height, texture.format, hides_alpha, line);
  send_bytes(std::as_bytes(std::span(finest.texels)), line);
}

void send_image(const OpenedPicture& opened, Line& line) {
  const Image image = image_of(opened);
  send_head(static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), core::TexelFormat::srgb, false,
            line);
  send_bytes(std::as_bytes(std::span(image.rgb)), line);
}

void serve_picture(const Message& request, Line& line, const PictureDecoder& decode) {
  Unpacker fields(request.bytes);
  const std::string name = fields.take_text(), format = fields.take_text();
  const std::unique_ptr<FileBytes> file = map_file(request.file, fields.take<std::uint64_t>());
  const EncodedPicture picture{file->bytes(), name, format, fields.take_choice(TextureAlpha::kept)};
  const PictureUse use = request.saying == Saying::weigh_picture  ? PictureUse::size
                         : request.saying == Saying::read_texture ? PictureUse::texture
                                                                  : PictureUse::image;
  const std::unique_ptr<OpenedPicture> opened = decode(picture, use);
  if (!opened) {
    line.send(Saying::left_to_another);
    return;
  }
  if (use == PictureUse::size) {
    const PictureForm form = opened->form();
    send_head(form.width, form.height, form.format, false, line);
  } else if (use == PictureUse::texture) {
    send_texture(*opened, picture, line);
  } else {
    send_image(*opened, line);
  }
  line.send(Saying::done);
}

}  // namespace

void serve_pictures(const PictureDecoder& decode) {
  serve_requests([&decode](const Message& request, Line& line) { serve_picture(request, line, decode); });
}

}  // namespace dmpc::apps
