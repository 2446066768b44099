#include "apps/picture/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <memory>
#include <string>

#include "apps/picture/picture_reader.h"
#include "apps/system/memory_file.h"
#include "apps/system/output_file.h"
#include "core/base/expect.h"
#include "core/base/srgb.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

constexpr int channels = 3;

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

bool takes_floats(const fs::path& path) {
  const std::string extension = lower_extension(path);
  for (const char* known : {".exr", ".tif", ".tiff", ".hdr"}) {
    if (extension == known) {
      return true;
    }
  }
  return false;
}

std::unique_ptr<OIIO::ImageOutput> create_output(const fs::path& path) {
  // OpenImageIO's "null" and "term" write no file.
  const std::string extension = lower_extension(path);
  std::unique_ptr<OIIO::ImageOutput> output;
  if (!extension.empty() && extension != ".null" && extension != ".term") {
    output = OIIO::ImageOutput::create(path.string());
  }
  if (!output) {
    static_cast<void>(OIIO::geterror());  // clears OpenImageIO's message
    throw core::InputError(path.string() + ": cannot write pictures " +
                           (extension.empty() ? "without an extension" : "of the kind " + extension) +
                           ", use .exr or .tif (linear floats), .png or .jpg (8 bits, sRGB)");
  }
  return output;
}

OIIO::ImageSpec specification(const fs::path& path, const Image& image) {
  const bool floats = takes_floats(path);
  OIIO::ImageSpec spec(image.width, image.height, channels, floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", floats ? "Linear" : "sRGB");
  spec.attribute("Software", "dmpc");
  if (floats) {
    spec.attribute("compression", "zip");
  } else {
    spec.attribute("CompressionQuality", 95);
  }
  return spec;
}

std::vector<std::uint8_t> srgb_bytes(const Image& image) {
  std::vector<std::uint8_t> bytes(image.rgb.size());
  std::transform(image.rgb.begin(), image.rgb.end(), bytes.begin(), core::srgb_byte);
  return bytes;
}

bool write_pixels(OIIO::ImageOutput& output, const fs::path& path, const Image& image) {
  return takes_floats(path) ? output.write_image(OIIO::TypeDesc::FLOAT, image.rgb.data())
                            : output.write_image(OIIO::TypeDesc::UINT8, srgb_bytes(image).data());
}

OIIO::ImageSpec specification(const Channel& channel) {
  OIIO::ImageSpec spec(channel.width, channel.height, 1, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {channel.name};
  spec.attribute("Software", "dmpc");
  spec.attribute("compression", "zip");
  for (const auto& [name, text] : channel.remarks) {
    spec.attribute(name, text);
  }
  return spec;
}

/// What a file in the format that `path` asks for has in it; write_all(output) returns whether its writing succeeded.
template <class WriteAll>
std::string file_of(const fs::path& path, const OIIO::ImageSpec& spec, const WriteAll& write_all) {
  const std::unique_ptr<OIIO::ImageOutput> output = create_output(path);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput into_bytes(bytes);
  const MemoryFile file;
  const bool takes_bytes = output->supports("ioproxy") && output->set_ioproxy(&into_bytes);
  const bool is_written = output->open(takes_bytes ? path.string() : file.path(), spec) && write_all(*output) && output->close();
  std::string text = takes_bytes ? std::string(bytes.begin(), bytes.end()) : file.bytes();
  if (!is_written || text.empty()) {
    throw core::InputError(path.string() + ": cannot be written: " + output->geterror());
  }
  return text;
}

}  // namespace

void check_image_path(const fs::path& path, std::string_view option) {
  static_cast<void>(create_output(path));
  check_output_path(path, option);
  if (is_special(path)) {
    throw core::InputError(
        std::string(option) + " " + path.string() +
        ": this is no ordinary file, and a picture is not written from front to back; give the name of a file");
  }
  static_cast<void>(encoded_picture(path, Image(1, 1)));
}

std::string encoded_picture(const fs::path& path, const Image& image) {
  core::expect(image.width > 0 && image.height > 0, "a picture to be written has at least one pixel");
  return file_of(path, specification(path, image), [&](OIIO::ImageOutput& output) { return write_pixels(output, path, image); });
}

std::string encoded_picture(const fs::path& path, const Channel& channel) {
  core::expect(channel.values.size() == static_cast<std::size_t>(channel.width) * static_cast<std::size_t>(channel.height),
               "a channel has a number for each pixel");
  return file_of(path, specification(channel),
                 [&](OIIO::ImageOutput& output) { return output.write_image(OIIO::TypeDesc::FLOAT, channel.values.data()); });
}

void write_image(const fs::path& path, const Image& image) { write_file(path, encoded_picture(path, image)); }

Image read_image(const fs::path& path) { return PictureReader().read_image(open_picture(path)); }

}  // namespace dmpc::apps
