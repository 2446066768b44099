#include "apps/foreign/plain_decoder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <limits>
#include <new>
#include <utility>

#include "apps/foreign/plain_picture.h"
#include "apps/picture/picture_format.h"
#include "core/scene/texture.h"

namespace dmpc::apps {
namespace {

using Byte = std::uint8_t;
using Wide = std::uint16_t;

/// As OpenImageIO makes them of each other: a float is as near to 1 as the value is to its largest.
float float_of(float value) { return value; }
float float_of(Byte value) { return static_cast<float>(value) * (1 / 255.0F); }
float float_of(Wide value) { return static_cast<float>(value) * (1 / 65535.0F); }
Byte byte_of(Byte value) { return value; }
/// What is no number is 0.
Byte byte_of(float value) {
  const float scaled = value * 255 + 0.5F;
  return scaled >= 0 ? static_cast<Byte>(std::min(scaled, 255.0F)) : Byte{0};
}
Byte byte_of(Wide value) { return byte_of(float_of(value)); }

class OpenedPlain final : public OpenedPicture {
 public:
  explicit OpenedPlain(RawPicture picture) : picture_(std::move(picture)) {}

  PictureForm form() const override {
    const core::TexelFormat format = picture_.value_bytes == sizeof(float)  ? core::TexelFormat::shared_exponent
                                     : picture_.value_bytes == sizeof(Wide) ? core::TexelFormat::fine_srgb
                                                                            : core::TexelFormat::srgb;
    return {picture_.width, picture_.height, picture_.channels, format};
  }
  std::vector<Byte> bytes(int count) const override {
    return made_of_values<Byte>(0, count, [](auto value) { return byte_of(value); });
  }
  std::vector<float> floats(int count) const override {
    return made_of_values<float>(0, count, [](auto value) { return float_of(value); });
  }
  std::vector<Byte> alpha() const override {
    auto alpha = has_alpha() ? alpha_made<Byte>([](auto value) { return byte_of(value); }) : std::vector<Byte>{};
    return std::all_of(alpha.begin(), alpha.end(), [](Byte value) { return value == 255; }) ? std::vector<Byte>{} : alpha;
  }
  /// Whether nothing of it would be multiplied by alpha: light is already, where it is to be.
  bool is_without_alpha() const {
    if (!has_alpha() || picture_.value_bytes == sizeof(float)) {
      return true;
    }
    const auto alpha = alpha_made<float>([](auto value) { return float_of(value); });
    return std::all_of(alpha.begin(), alpha.end(), [](float value) { return value >= 1; });
  }

 private:
  std::size_t pixels() const { return std::size_t{picture_.width} * picture_.height; }
  template <class Value>
  Value value_at(std::size_t pixel, int channel) const {
    Value value{};
    const std::size_t index = pixel * static_cast<std::size_t>(picture_.channels) + static_cast<std::size_t>(channel);
    std::memcpy(&value, picture_.values.data() + index * sizeof(Value), sizeof(Value));
    return value;
  }
  template <class Made, class Value, class Make>
  std::vector<Made> made_of(int first, int count, const Make& make) const {
    std::vector<Made> made(pixels() * static_cast<std::size_t>(count));
    auto next = made.begin();
    for (std::size_t pixel = 0; pixel < pixels(); ++pixel) {
      for (int channel = first; channel < first + count; ++channel) {
        *next++ = make(value_at<Value>(pixel, channel));
      }
    }
    return made;
  }
  /// Converts `count` channels from `first` on.
  template <class Made, class Make>
  std::vector<Made> made_of_values(int first, int count, const Make& make) const {
    return picture_.value_bytes == sizeof(float)  ? made_of<Made, float>(first, count, make)
           : picture_.value_bytes == sizeof(Wide) ? made_of<Made, Wide>(first, count, make)
                                                  : made_of<Made, Byte>(first, count, make);
  }
  template <class Made, class Make>
  std::vector<Made> alpha_made(const Make& make) const {
    return made_of_values<Made>(picture_.channels - 1, 1, make);
  }
  bool has_alpha() const { return picture_.channels % 2 == 0; }

  RawPicture picture_;
};

/// By plain_formats.
constexpr std::array readers{&png_picture, &jpeg_picture, &exr_picture};
static_assert(readers.size() == plain_formats.size(), "each plain format has a reader");

std::optional<RawPicture> plain_picture(const EncodedPicture& picture, PictureUse use) {
  const auto format = std::ranges::find(plain_formats, picture.format) - plain_formats.begin();
  const bool has_values = use != PictureUse::size;
  const std::uint64_t pixels_max = has_values ? plain_pixels_max : std::numeric_limits<std::uint64_t>::max();
  return format < std::ssize(readers) ? readers[static_cast<std::size_t>(format)](picture.bytes, pixels_max, has_values)
                                      : std::nullopt;
}

}  // namespace

bool is_plain_size(std::uint64_t width, std::uint64_t height, std::uint64_t value_bytes, std::uint64_t file_bytes,
                   std::uint64_t pixels_max) {
  return width > 0 && height > 0 && width <= core::Texture::size_max && height <= core::Texture::size_max &&
         width * height <= pixels_max && decoded_bytes(width, height, value_bytes) <= decoded_bytes_max(file_bytes);
}

std::unique_ptr<OpenedPicture> decode_plain(const EncodedPicture& picture, PictureUse use) {
  try {
    std::optional<RawPicture> plain = plain_picture(picture, use);
    if (!plain) {
      return nullptr;
    }
    auto opened = std::make_unique<OpenedPlain>(*std::move(plain));
    return use != PictureUse::image || opened->is_without_alpha() ? std::move(opened) : nullptr;
  } catch (const std::bad_alloc&) {  // OpenImageIO takes less, or reports that memory is exhausted
    return nullptr;
  }
}

}  // namespace dmpc::apps
