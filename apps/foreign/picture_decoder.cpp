#include "apps/foreign/picture_decoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <type_traits>
#include <vector>

#include "apps/foreign/opaque_picture.h"
#include "apps/picture/picture_format.h"
#include "apps/picture/texture_file.h"
#include "core/base/expect.h"
#include "core/database/record_writer.h"

namespace dmpc::apps {
namespace {

/// So many texels has the finest level at most: four bytes each, and a third of that for the other levels.
constexpr std::size_t texels_max = core::RecordWriter::bytes_max / 16 * 3;

std::size_t texel_count(const OIIO::ImageSpec& spec) {
  return static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
}

/// An open picture, with the memory that it is read from.
struct Input {
  std::optional<std::vector<std::byte>> opaque;  ///< in place of the file's own bytes
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
  std::unique_ptr<OIIO::ImageInput> image;

  const OIIO::ImageSpec& spec() const { return image->spec(); }
};

[[noreturn]] void fail_to_read(const std::string& name, const std::string& why) {
  throw core::InputError(name + ": cannot be read as a picture: " + why);
}

void check_declared(const EncodedPicture& picture, const OIIO::ImageSpec& spec) {
  const auto width = static_cast<std::uint64_t>(std::max(spec.width, 0)),
             height = static_cast<std::uint64_t>(std::max(spec.height, 0));
  if (width == 0 || height == 0) {
    throw core::InputError(picture.name + ": says that it has " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
                           " pixels, expected at least one: it is damaged");
  }
  if (width > picture_side_max || height > picture_side_max ||
      decoded_bytes(width, height, spec.format.basesize()) > decoded_bytes_max(picture.bytes.size())) {
    throw core::InputError(picture.name + ": says that it has " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
                           " pixels, more than " + std::to_string(picture.bytes.size()) + " bytes can hold: it is damaged");
  }
}

/// OpenImageIO 2.4.7 looks for the lowest bit of each mask of a DDS of plain pixels, for ever if there is none.
void check_masks(const EncodedPicture& picture) {
  constexpr std::size_t flags_at = 80, masks_at = 92, header_bytes = 128;
  constexpr std::uint32_t has_alpha = 0x1, is_packed = 0x4, has_colors = 0x40;
  const auto word_at = [&](std::size_t place) {
    std::uint32_t word = 0;
    std::memcpy(&word, picture.bytes.data() + place, sizeof(word));
    return word;
  };
  if (picture.format != "dds" || picture.bytes.size() < header_bytes) {
    return;
  }
  const std::uint32_t flags = word_at(flags_at);
  constexpr std::array names{"red", "green", "blue", "alpha"};
  const std::size_t masks = (flags & (is_packed | has_colors)) != has_colors ? 0 : (flags & has_alpha) != 0 ? 4 : 3;
  for (std::size_t mask = 0; mask < masks; ++mask) {
    if (word_at(masks_at + mask * sizeof(std::uint32_t)) == 0) {
      fail_to_read(picture.name, std::string("its pixels have no bits of ") + names[mask] +
                                     ", and those of its kind have: write it anew, or as another format");
    }
  }
}

/// Where `unassociated`, colours come as they are, and not multiplied by alpha.
Input open(const EncodedPicture& picture, bool unassociated) {
  check_masks(picture);
  Input input;
  input.opaque = unassociated ? made_opaque(picture.format, picture.bytes) : std::nullopt;
  const std::span<const std::byte> bytes = input.opaque ? std::span<const std::byte>(*input.opaque) : picture.bytes;
  input.memory = std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<std::byte*>(bytes.data()), bytes.size());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", unassociated ? 1 : 0);
  void* const proxy = input.memory.get();
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  input.image = OIIO::ImageInput::create(picture.format, false, nullptr, nullptr, "");
  if (!input.image) {
    fail_to_read(picture.name, OIIO::geterror());
  }
  OIIO::ImageSpec spec;
  if (!input.image->open(picture.name, spec, config)) {
    fail_to_read(picture.name, input.image->geterror());
  }
  check_declared(picture, input.spec());
  return input;
}

Input open_texture(const EncodedPicture& picture) {
  Input input = open(picture, true);
  const OIIO::ImageSpec& spec = input.spec();
  check_texture_size(picture.name, spec.width, spec.height);
  if (spec.depth > 1 || spec.deep) {
    throw core::InputError(picture.name + ": a texture with " + (spec.deep ? "several samples a texel" : "several layers") +
                           "; expected a plain picture");
  }
  if (texel_count(spec) > texels_max) {
    throw core::InputError(picture.name + ": a texture of " + std::to_string(texel_count(spec)) + " texels; expected at most " +
                           std::to_string(texels_max) + ", which fill a database: make it smaller");
  }
  return input;
}

/// Reads `count` channels from `first` on.
template <class T>
std::vector<T> read_values(const Input& input, const std::string& name, OIIO::TypeDesc type, int first, int count) {
  std::vector<T> values(texel_count(input.spec()) * static_cast<std::size_t>(count));
  if (!input.image->read_image(0, 0, first, first + count, type, values.data())) {
    throw core::InputError(name + ": cannot be read: " + input.image->geterror());
  }
  return values;
}

/// Whether the file itself holds colours that are multiplied by alpha, as TIFF and TGA may; EXR's are light, and stay as they
/// are.
bool is_associated(const EncodedPicture& picture, const OIIO::ImageSpec& spec) {
  return (picture.format == "tiff" || picture.format == "targa") && spec.alpha_channel >= 0 &&
         spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
}

/// Divides `count` values of each texel by its alpha, `whole` of which is 1; where that is 0 nothing is known.
template <class T>
void divide_by_alpha(std::vector<T>& values, const std::vector<T>& alpha, std::size_t count, float whole) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto share = static_cast<float>(alpha[i / count]);
    const float divided =
        share > 0 ? std::min(static_cast<float>(values[i]) * whole / share, whole) : static_cast<float>(values[i]);
    values[i] = std::is_integral_v<T> ? static_cast<T>(std::lround(divided)) : static_cast<T>(divided);
  }
}

core::TexelFormat format_for(const OIIO::ImageSpec& spec) {
  return spec.format.is_floating_point()        ? core::TexelFormat::shared_exponent
         : spec.format == OIIO::TypeDesc::UINT8 ? core::TexelFormat::srgb
                                                : core::TexelFormat::fine_srgb;
}

class OpenedByLibrary final : public OpenedPicture {
 public:
  OpenedByLibrary(const EncodedPicture& picture, PictureUse use)
      : picture_(picture), use_(use), input_(use == PictureUse::image ? open(picture_, false) : open_texture(picture_)) {}

  PictureForm form() const override {
    const OIIO::ImageSpec& spec = input_.spec();
    return {static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height), spec.nchannels, format_for(spec)};
  }
  std::vector<std::uint8_t> bytes(int count) const override { return colors<std::uint8_t>(OIIO::TypeDesc::UINT8, count); }
  std::vector<float> floats(int count) const override { return colors<float>(OIIO::TypeDesc::FLOAT, count); }

  std::vector<std::uint8_t> alpha() const override {
    const Input input = open(picture_, false);
    const int channel = input.spec().alpha_channel;
    if (channel < 0) {
      return {};
    }
    auto alpha = read_values<std::uint8_t>(input, picture_.name, OIIO::TypeDesc::UINT8, channel, 1);
    const bool is_opaque = std::all_of(alpha.begin(), alpha.end(), [](std::uint8_t value) { return value == 255; });
    return is_opaque ? std::vector<std::uint8_t>{} : alpha;
  }

 private:
  template <class T>
  std::vector<T> colors(OIIO::TypeDesc type, int count) const {
    std::vector<T> values = read_values<T>(input_, picture_.name, type, 0, count);
    if (use_ == PictureUse::texture && is_associated(picture_, input_.spec())) {
      const std::vector<T> alpha = read_values<T>(input_, picture_.name, type, input_.spec().alpha_channel, 1);
      divide_by_alpha(values, alpha, static_cast<std::size_t>(count), std::is_integral_v<T> ? 255 : 1);
    }
    return values;
  }

  EncodedPicture picture_;
  PictureUse use_;
  Input input_;
};

}  // namespace

/// The first reader of a kind that is made has the library look round for others, and load what lies where these variables say.
void prepare_decoders() {
  ::unsetenv("OIIO_LIBRARY_PATH");
  ::unsetenv("LD_LIBRARY_PATH");
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  for (const char* format : {"png", "jpeg", "openexr", "tiff", "targa", "bmp", "hdr", "webp", "gif", "pnm", "dds"}) {
    static_cast<void>(OIIO::ImageInput::create(format, false, nullptr, nullptr, ""));
  }
  static_cast<void>(OIIO::geterror());
}

std::unique_ptr<OpenedPicture> decode(const EncodedPicture& picture, PictureUse use) {
  return std::make_unique<OpenedByLibrary>(picture, use);
}

}  // namespace dmpc::apps
