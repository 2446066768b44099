// What is decoded without OpenImageIO, held against what it gives.
#include "apps/foreign/plain_decoder.h"

#include <doctest/doctest.h>

#include <bit>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/picture_decoder.h"
#include "apps/foreign/plain_picture.h"
#include "apps/picture/picture_format.h"
#include "core/base/expect.h"
#include "tests/apps/foreign/made_exr.h"
#include "tests/apps/foreign/made_pictures.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::plain_decoder_test {

namespace {

using apps::EncodedPicture;
using apps::OpenedPicture;
using apps::PictureUse;
using apps::TextureAlpha;

std::span<const std::byte> bytes_of(const std::string& file) { return std::as_bytes(std::span(file)); }

EncodedPicture picture_of(const std::string& file, TextureAlpha alpha = TextureAlpha::kept) {
  const std::optional<std::string> format = apps::picture_format(file, "");
  REQUIRE(format);
  return {bytes_of(file), "picture", *format, alpha};
}

/// What is no number is equal, too.
std::vector<std::uint32_t> bits_of(const std::vector<float>& floats) {
  std::vector<std::uint32_t> bits;
  for (const float number : floats) {
    bits.push_back(std::bit_cast<std::uint32_t>(number));
  }
  return bits;
}

/// All that may be asked of it.
struct Seen {
  std::uint32_t width = 0, height = 0;
  int channels = 0;
  core::TexelFormat format{}, kept_format{};
  std::vector<std::uint8_t> bytes, alpha;
  std::vector<float> floats;
  std::vector<std::uint32_t> texels, kept_texels;

  bool operator==(const Seen& other) const {
    return width == other.width && height == other.height && channels == other.channels && format == other.format &&
           kept_format == other.kept_format && bytes == other.bytes && alpha == other.alpha &&
           bits_of(floats) == bits_of(other.floats) && texels == other.texels && kept_texels == other.kept_texels;
  }
};

std::vector<std::uint32_t> texels_of(const OpenedPicture& opened, const EncodedPicture& picture, core::TexelFormat& format) {
  const core::Texture texture = apps::texture_of(opened, picture);
  format = texture.format;
  return texture.levels.front().texels;
}

template <class Decode>
std::optional<Seen> seen_as_texture(const std::string& file, const Decode& decode) {
  const auto opened = decode(picture_of(file), PictureUse::texture);
  if (!opened) {
    return std::nullopt;
  }
  const apps::PictureForm form = opened->form();
  const int count = form.channels < 3 ? 1 : 3;
  Seen seen{.width = form.width,
            .height = form.height,
            .channels = form.channels,
            .bytes = opened->bytes(count),
            .alpha = opened->alpha(),
            .floats = opened->floats(count)};
  seen.texels = texels_of(*opened, picture_of(file, TextureAlpha::ignored), seen.format);
  seen.kept_texels = texels_of(*opened, picture_of(file), seen.kept_format);
  return seen;
}

template <class Decode>
std::optional<std::vector<std::uint32_t>> seen_as_image(const std::string& file, const Decode& decode) {
  const auto opened = decode(picture_of(file), PictureUse::image);
  return opened ? std::optional(bits_of(apps::image_of(*opened).rgb)) : std::nullopt;
}

/// Whether the plain decoder takes the file and gives the same result as OpenImageIO for all uses.
bool is_as_by_library(const std::string& file) {
  static const bool is_prepared = (apps::prepare_decoders(), true);
  const auto as_texture = seen_as_texture(file, apps::decode_plain);
  const auto as_image = seen_as_image(file, apps::decode_plain);
  CHECK((!as_image || as_texture));
  CHECK((!as_texture || as_texture == seen_as_texture(file, apps::decode)));
  CHECK((!as_image || as_image == seen_as_image(file, apps::decode)));
  return is_prepared && as_texture.has_value();
}

bool is_decoded_as_image(const std::string& file) { return seen_as_image(file, apps::decode_plain).has_value(); }

/// Size of a PNG's signature and first chunk.
constexpr std::size_t header_bytes = 33;

/// A PNG that says something more, before its pixels.
std::string with_chunk(const std::string& png, const std::string& name, const std::string& content) {
  std::string chunk;
  const auto add_number = [&chunk](std::uint64_t number) {
    for (const unsigned shift : {24U, 16U, 8U, 0U}) {
      chunk += static_cast<char>(number >> shift);
    }
  };
  add_number(content.size());
  chunk += name + content;
  std::uint32_t check = 0xffffffffU;  // covers name and content (PNG specification, annex D)
  for (const char byte : name + content) {
    check ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) {
      check = (check & 1U) != 0 ? 0xedb88320U ^ check >> 1U : check >> 1U;
    }
  }
  add_number(check ^ 0xffffffffU);
  return png.substr(0, header_bytes) + chunk + png.substr(header_bytes);
}

}  // namespace

TEST_CASE(
    "a PNG of every colour and depth, interlaced or not, with transparency or without, has the bits that OpenImageIO gives") {
  for (const PngKind& kind : all_png_kinds()) {
    CAPTURE(kind.text());
    CHECK(is_as_by_library(png_of(kind)));
  }
}

TEST_CASE("so has one of one pixel, of one row, of one column, and of several parts") {
  for (PngKind kind : all_png_kinds()) {
    for (const auto& [width, height] : {std::pair<png_uint_32, png_uint_32>{1, 1}, {40, 1}, {1, 40}, {90, 150}}) {
      kind.width = width;
      kind.height = height;
      CAPTURE(kind.text());
      CHECK(is_as_by_library(png_of(kind)));
    }
  }
}

TEST_CASE("all values of 8 and of 16 bits become the bytes and floats that OpenImageIO makes of them, and so do those of alpha") {
  std::vector<std::uint8_t> wide, narrow;
  for (unsigned value = 0; value < 65536; ++value) {
    for (const unsigned part : {value, 65535 - value}) {
      wide.push_back(static_cast<std::uint8_t>(part >> 8U));
      wide.push_back(static_cast<std::uint8_t>(part));
    }
    narrow.push_back(static_cast<std::uint8_t>(value));
    narrow.push_back(static_cast<std::uint8_t>(value >> 8U));
  }
  CHECK(is_as_by_library(png_of({.width = 256, .height = 256, .color = PNG_COLOR_TYPE_GRAY_ALPHA, .depth = 16}, wide)));
  CHECK(is_as_by_library(png_of({.width = 256, .height = 256, .color = PNG_COLOR_TYPE_GRAY_ALPHA, .depth = 8}, narrow)));
}

TEST_CASE("an image with alpha is left to OpenImageIO, which multiplies by it, unless all of it is 1, whatever gamma it says") {
  const std::vector<std::uint8_t> clear = random_bytes(4000, 3);
  std::vector<std::uint8_t> opaque = clear;
  for (std::size_t i = 3; i < opaque.size(); i += 4) {
    opaque[i] = 255;
  }
  for (const double gamma : {0.0, 1.0, 0.45455, 0.7}) {
    PngKind kind{.color = PNG_COLOR_TYPE_RGB_ALPHA, .depth = 8};
    kind.add = [gamma](png_structp png, png_infop info) {
      if (gamma > 0) {
        png_set_gAMA(png, info, gamma);
      }
    };
    CAPTURE(gamma);
    CHECK(is_as_by_library(png_of(kind, clear)));
    CHECK_FALSE(is_decoded_as_image(png_of(kind, clear)));
    CHECK(is_as_by_library(png_of(kind, opaque)));
    CHECK(is_decoded_as_image(png_of(kind, opaque)));
    kind.depth = 16;
    std::vector<std::uint8_t> wide = random_bytes(8000, 3);
    for (std::size_t i = 6; i < wide.size(); i += 8) {
      wide[i] = wide[i + 1] = 255;
    }
    CHECK(is_as_by_library(png_of(kind, wide)));
    CHECK(is_decoded_as_image(png_of(kind, wide)));
  }
}

TEST_CASE("what a PNG says beside its pixels changes nothing, nonsense or not, unless it is damaged on its way") {
  const std::string plain = png_of({});
  for (const auto& [name, content] :
       std::vector<std::pair<std::string, std::string>>{{"gAMA", std::string("\0\0\xb1\x8f", 4)},
                                                        {"gAMA", std::string("\0\0\0\0", 4)},
                                                        {"gAMA", "too long for it"},
                                                        {"sRGB", std::string("\0", 1)},
                                                        {"oFFs", std::string("\0\0\0\5\0\0\0\7\0", 9)},
                                                        {"oFFs", std::string("\xff\xff\xff\5\xff\xff\xff\7\0", 9)},
                                                        {"pHYs", std::string("\0\0\0\5\0\0\0\7\0", 9)},
                                                        {"bKGD", std::string("\0\1\0\2\0\3", 6)},
                                                        {"iCCP", std::string("sRGB\0\0no profile", 16)},
                                                        {"tEXt", std::string("Title\0a text", 12)},
                                                        {"zTXt", std::string("Title\0\0no packed text", 21)},
                                                        {"eXIf", "MM of nothing"},
                                                        {"sBIT", std::string("\5\6\5", 3)},
                                                        {"prVt", "what nobody knows"}}) {
    CAPTURE(name);
    std::string file = with_chunk(plain, name, content);
    CHECK(is_as_by_library(file));
    file[file.size() - plain.size() + header_bytes - 1] ^= 1;  // the chunk's checksum
    CHECK_FALSE(is_as_by_library(file));
  }
}

TEST_CASE("a JPEG in grey or in colours has the bits that OpenImageIO gives, however it is packed") {
  for (const J_COLOR_SPACE colors : {JCS_GRAYSCALE, JCS_YCbCr}) {
    for (const auto& [across, down] : {std::pair(1, 1), {2, 1}, {1, 2}, {2, 2}, {4, 1}, {4, 2}}) {
      for (const bool is_progressive : {false, true}) {
        for (const unsigned restart : {0U, 2U}) {
          for (const auto& [width, height] : {std::pair<JDIMENSION, JDIMENSION>{37, 29}, {1, 1}, {200, 160}}) {
            const JpegKind kind{.width = width,
                                .height = height,
                                .colors = colors,
                                .across = across,
                                .down = down,
                                .is_progressive = is_progressive,
                                .restart = restart};
            CAPTURE(kind.text());
            CHECK(is_as_by_library(jpeg_of(kind)));
          }
        }
      }
    }
  }
  CHECK(is_as_by_library(jpeg_of({.is_arithmetic = true})));
  CHECK(is_as_by_library(jpeg_of({.quality = 1})));
}

TEST_CASE("a JPEG that says it is turned is not turned, by either") {
  std::string exif("Exif\0\0MM\0*\0\0\0\10\0\1\1\22\0\3\0\0\0\1\0\6\0\0\0\0\0\0", 32);
  CHECK(is_as_by_library(jpeg_of({.exif = exif})));
}

TEST_CASE("a JPEG for printers, or of colours that are no brightness, is left to OpenImageIO") {
  for (const J_COLOR_SPACE colors : {JCS_CMYK, JCS_YCCK, JCS_RGB}) {
    CHECK_FALSE(apps::jpeg_picture(bytes_of(jpeg_of({.colors = colors, .across = 1, .down = 1}))));
  }
}

TEST_CASE("an EXR of light, in rows, has the bits that OpenImageIO gives, whatever numbers it has") {
  for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
    for (const auto compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
                                   Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::DWAA_COMPRESSION}) {
      for (const std::vector<std::string>& channels :
           std::vector<std::vector<std::string>>{{"R", "G", "B"}, {"R", "G", "B", "A"}, {"Y"}}) {
        for (const auto& [left, top] : {std::pair(0, 0), {-3, 7}}) {
          const ExrKind kind{.left = left, .top = top, .channels = channels, .type = type, .compression = compression};
          CAPTURE(kind.text());
          CHECK(is_as_by_library(exr_of(kind)));
          CHECK(is_decoded_as_image(exr_of(kind)));
        }
      }
    }
  }
  CHECK(is_as_by_library(exr_of({.order = Imf::DECREASING_Y})));
  CHECK(is_as_by_library(exr_of({.width = 1, .height = 1})));
  CHECK(is_as_by_library(exr_of({.width = 256, .height = 256, .channels = {"Y"}})));
}

TEST_CASE("an EXR of other channels or in tiles, or with what is no number, is left to OpenImageIO") {
  for (const ExrKind& kind : std::vector<ExrKind>{{.channels = {"R", "G"}},
                                                  {.channels = {"R", "G", "B", "Z"}},
                                                  {.channels = {"left.R", "left.G", "left.B"}},
                                                  {.type = Imf::UINT},
                                                  {.has_tiles = true},
                                                  {.are_all_numbers = false}}) {
    CAPTURE(kind.text());
    CHECK_FALSE(is_as_by_library(exr_of(kind)));
  }
}

TEST_CASE("what is damaged is left to OpenImageIO, or has the bits that it gives") {
  const std::vector<std::string> files = {png_of({}),
                                          png_of({.depth = 16, .is_interlaced = true}),
                                          png_of({.color = PNG_COLOR_TYPE_PALETTE, .depth = 4, .has_transparency = true}),
                                          jpeg_of({}),
                                          jpeg_of({.colors = JCS_GRAYSCALE, .is_progressive = true, .restart = 2}),
                                          exr_of({}),
                                          exr_of({.type = Imf::FLOAT, .compression = Imf::PIZ_COMPRESSION})};
  std::size_t left = 0, decoded = 0;
  for (std::size_t which = 0; which < files.size(); ++which) {
    const std::string& file = files[which];
    for (std::uint64_t trial = 0; trial < 150; ++trial) {
      const std::uint64_t random = core::mix(which << 32U | trial);
      const std::size_t place = 16 + random % (file.size() - 16);
      std::string damaged = file;
      if (trial % 3 == 0) {
        damaged.resize(place);
      } else {
        damaged[place] = static_cast<char>(damaged[place] ^ 1 << (random >> 32U) % 8);
      }
      CAPTURE(which);
      CAPTURE(trial);
      ++(is_as_by_library(damaged) ? decoded : left);
    }
  }
  CHECK(left > 100);
  CHECK(decoded > 10);
}

TEST_CASE("pictures in this repository are decoded as by OpenImageIO") {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(DMPC_SOURCE_DIR "/apps")) {
    if (entry.path().extension() == ".png") {
      CAPTURE(entry.path());
      CHECK(is_as_by_library(file_text(entry.path())));
      ++count;
    }
  }
  CHECK(count > 4);
}

TEST_CASE("a picture that is too large for its file, for a texture, or for the plain way is left to OpenImageIO") {
  const std::string file = png_of({.width = 100, .height = 50});
  CHECK(apps::png_picture(bytes_of(file), 5000));
  CHECK_FALSE(apps::png_picture(bytes_of(file), 4999));
  CHECK_FALSE(apps::jpeg_picture(bytes_of(jpeg_of({})), 1000));
  CHECK(apps::is_plain_size(65535, 1, 1, 1000, apps::plain_pixels_max));
  CHECK_FALSE(apps::is_plain_size(65536, 1, 1, 1000, apps::plain_pixels_max));
  CHECK_FALSE(apps::is_plain_size(0, 1, 1, 1000, apps::plain_pixels_max));
  CHECK_FALSE(apps::is_plain_size(65535, 65535, 1, 1000, std::uint64_t{1} << 40U));
}

TEST_CASE("how large a picture is stands before its pixels, which are not decoded for that") {
  for (const std::string& file : {png_of({.width = 100, .height = 50}), jpeg_of({}), exr_of({})}) {
    const apps::EncodedPicture picture = picture_of(file);
    const auto whole = apps::decode_plain(picture, PictureUse::texture)->form();
    const apps::EncodedPicture cut{picture.bytes.first(file.size() - 20), picture.name, picture.format};
    CHECK_FALSE(apps::decode_plain(cut, PictureUse::texture));
    const auto form = apps::decode_plain(cut, PictureUse::size)->form();
    CHECK(form.width == whole.width);
    CHECK(form.height == whole.height);
  }
}

}  // namespace dmpc::tests::plain_decoder_test
