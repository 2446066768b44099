// Any bytes as a picture, by the first byte in a file that ends with .tga or with nothing: no format that is known, refused with
// core::InputError, or a texture and an image of the size that the file says, the same without OpenImageIO where that can be. Of
// OpenImageIO's readers those are left out that are known to fail themselves, which is what readers are processes of their own
// for; a JPEG is read without it alone, and an EXR first.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "apps/foreign/picture_decoder.h"
#include "apps/foreign/plain_decoder.h"
#include "apps/foreign/plain_picture.h"
#include "apps/picture/picture_format.h"
#include "core/base/expect.h"
#include "tests/fuzz/targets.h"

namespace dmpc::fuzz {

namespace {

using apps::PictureUse;
using core::expect;

constexpr std::array<std::string_view, 3> formats_held{"png", "hdr", "pnm"};
/// Larger ones are slow, and find nothing new.
constexpr std::uint64_t pixels_max = 4096;

/// What the file says of its size: nothing if it is too large to be tried.
bool is_small(const apps::EncodedPicture& picture) {
  OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(picture.bytes.data()), picture.bytes.size());
  OIIO::ImageSpec spec, config;
  void* const proxy = &memory;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const auto image = OIIO::ImageInput::create(picture.format, false, nullptr, nullptr, "");
  return !image->open(picture.name, spec, config) || spec.width > static_cast<int>(apps::picture_side_max) ||
         std::uint64_t(std::max(spec.width, 0)) * std::uint64_t(std::max(spec.height, 0)) <= pixels_max;
}

template <class Decode>
auto decoded(const apps::EncodedPicture& picture, const Decode& decode) -> std::optional<decltype(decode(picture))> {
  try {
    return decode(picture);
  } catch (const core::InputError& error) {
    expect(std::string_view(error.what()).starts_with("input: "), "who refuses says what");
    return std::nullopt;
  }
}

core::Texture texture_of(const apps::EncodedPicture& picture) {
  return apps::texture_of(*apps::decode(picture, PictureUse::texture), picture);
}

apps::Image image_of(const apps::EncodedPicture& picture) { return apps::image_of(*apps::decode(picture, PictureUse::image)); }

/// Held against what OpenImageIO makes of it.
void try_plainly(const apps::EncodedPicture& picture, const std::optional<core::Texture>& texture,
                 const std::optional<apps::Image>& image) {
  const auto plain_texture = apps::decode_plain(picture, PictureUse::texture);
  if (plain_texture) {
    const core::Texture plain = apps::texture_of(*plain_texture, picture);
    expect(texture && plain.format == texture->format && plain.levels.front().texels == texture->levels.front().texels,
           "a texture is the same without OpenImageIO");
  }
  const auto plain_image = apps::decode_plain(picture, PictureUse::image);
  if (plain_image) {
    expect(image && apps::image_of(*plain_image).rgb == image->rgb, "an image is the same without OpenImageIO");
  }
  if (std::ranges::find(apps::plain_formats, picture.format) != apps::plain_formats.end()) {
    covered().count(picture.format + ": a texture without OpenImageIO", plain_texture != nullptr);
    covered().count(picture.format + ": an image without OpenImageIO", plain_image != nullptr);
  }
}

/// What is read without OpenImageIO alone; whether it can be.
bool try_alone(const std::string& format, const std::optional<apps::RawPicture>& picture) {
  if (picture) {
    const std::size_t pixels = std::size_t{picture->width} * picture->height;
    expect(picture->values.size() == pixels * static_cast<std::size_t>(picture->channels) * picture->value_bytes,
           "every value is there");
  }
  covered().count(format + " decoded", picture.has_value());
  covered().count(format + " left to OpenImageIO", !picture);
  return picture.has_value();
}

void try_picture(const apps::EncodedPicture& picture) {
  const auto texture = decoded(picture, texture_of);
  for (const std::string_view format : formats_held) {
    covered().count(std::string(format) + " decoded", picture.format == format && texture);
    covered().count(std::string(format) + " refused", picture.format == format && !texture);
  }
  if (texture) {
    expect(texture->levels.size() == 1, "the finest level alone is decoded");
    const core::TextureLevel& level = texture->levels.front();
    expect(level.texels.size() == std::uint64_t{level.width} * level.height && !level.texels.empty(), "every texel is there");
  }
  const auto image = decoded(picture, image_of);
  if (image) {
    expect(image->rgb.size() == std::size_t{3} * static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height),
           "every pixel is there");
  }
  try_plainly(picture, texture, image);
}

}  // namespace

/// libpng leaves by longjmp, past what OpenImageIO has to give back.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }

void try_picture(const std::uint8_t* data, std::size_t size) {
  static std::once_flag prepared;
  std::call_once(prepared, apps::prepare_decoders);
  if (size == 0) {
    return;
  }
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto format = apps::picture_format(text, data[0] % 2 == 1 ? "TGA" : "");
  if (!format) {
    return;
  }
  const apps::EncodedPicture picture{bytes, "input", *format, apps::TextureAlpha::kept};
  const bool is_held = std::find(formats_held.begin(), formats_held.end(), *format) != formats_held.end();
  if (*format == "jpeg") {
    try_alone(*format, apps::jpeg_picture(bytes, pixels_max));
  } else if (*format == "openexr" ? try_alone(*format, apps::exr_picture(bytes, pixels_max)) : is_held && is_small(picture)) {
    try_picture(picture);
  }
}

}  // namespace dmpc::fuzz
