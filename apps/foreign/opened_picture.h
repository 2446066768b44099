// A picture's file, the picture that a library has opened, and what becomes of it, whichever library that was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/picture/image_file.h"
#include "apps/picture/texture_file.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

/// Before anybody has looked into it.
struct EncodedPicture {
  std::span<const std::byte> bytes;            ///< the whole file
  std::string name;                            ///< for messages
  std::string format;                          ///< OpenImageIO's name (apps/picture/picture_format.h)
  TextureAlpha alpha = TextureAlpha::ignored;  ///< a texture's, unless it is 1 everywhere
};

/// What a picture is opened for.
enum class PictureUse : std::uint8_t {
  size,     ///< its form alone; no pixel is decoded
  texture,  ///< colours are as they are without alpha
  image     ///< colours are multiplied by alpha, as OpenImageIO multiplies them
};

struct PictureForm {
  std::uint32_t width = 0, height = 0;  ///< pixels
  int channels = 0;
  /// Format of a texture without alpha, by its number type alone: srgb for bytes, fine_srgb for other integers, shared_exponent
  /// for floats. A gamma or profile in the file does not count for a surface's colour (glTF 2.0, 3.9.2), nor for other textures,
  /// whose writers rarely intend it.
  core::TexelFormat format{};
};

/// The library's complaints are core::InputError "NAME: ...".
class OpenedPicture {
 public:
  OpenedPicture() = default;
  virtual ~OpenedPicture() = default;
  OpenedPicture(const OpenedPicture&) = delete;
  OpenedPicture& operator=(const OpenedPicture&) = delete;

  virtual PictureForm form() const = 0;
  /// The first `count` channels of each pixel, row by row: 255 is 1.
  virtual std::vector<std::uint8_t> bytes(int count) const = 0;
  /// As floats; integers are scaled to 0 to 1.
  virtual std::vector<float> floats(int count) const = 0;
  /// One a pixel, 255 is 1; empty if there is none, or if all are.
  virtual std::vector<std::uint8_t> alpha() const = 0;
};

/// The finest level alone, as apps/picture/picture_reader.h says; edges are left to others. Requires a picture that was opened
/// for a texture.
core::Texture texture_of(const OpenedPicture& opened, const EncodedPicture& picture);
/// As apps/picture/image_file.h says. Requires a picture that was opened for an image.
Image image_of(const OpenedPicture& opened);

}  // namespace dmpc::apps
