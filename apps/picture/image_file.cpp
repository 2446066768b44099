#include "apps/picture/image_file.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <span>
#include <string>

#include "apps/edge/system/output_file.h"
#include "apps/edge/system/shortage.h"
#include "apps/picture/exr_file.h"
#include "apps/picture/picture_reader.h"
#include "apps/picture/picture_writer.h"
#include "apps/picture/png_file.h"
#include "core/base/expect.h"
#include "core/base/srgb.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

bool takes_floats(std::string_view extension) {
  return extension == ".exr" || extension == ".tif" || extension == ".tiff" || extension == ".hdr";
}

/// A process that takes long to start is asked about all but these two.
void check_extension(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".exr" && extension != ".png" && (extension.empty() || !picture_writer().writes(extension))) {
    throw core::InputError(path.string() + ": cannot write pictures " +
                           (extension.empty() ? "without an extension" : "of the kind " + extension) +
                           ", use .exr or .tif (linear floats), .png or .jpg (8 bits, sRGB)");
  }
}

std::vector<std::uint8_t> srgb_bytes(const Image& image) {
  std::vector<std::uint8_t> bytes(image.rgb.size());
  std::transform(image.rgb.begin(), image.rgb.end(), bytes.begin(), core::srgb_byte);
  return bytes;
}

std::string exr_of(const Image& image) {
  const std::span<const float> values(image.rgb);
  return exr_file({.width = image.width,
                   .height = image.height,
                   .channels = {{"R", values, 3}, {"G", values.subspan(1), 3}, {"B", values.subspan(2), 3}},
                   .remarks = image.remarks});
}

std::string file_of(const fs::path& path, const Image& image) {
  const bool are_floats = takes_floats(lower_extension(path));
  const std::vector<std::uint8_t> bytes = are_floats ? std::vector<std::uint8_t>() : srgb_bytes(image);
  const PictureValues picture{.width = image.width,
                              .height = image.height,
                              .are_floats = are_floats,
                              .values = are_floats ? std::as_bytes(std::span(image.rgb)) : std::as_bytes(std::span(bytes))};
  try {
    return picture_writer().file_of(path.string(), picture);
  } catch (const ComputerRoomError&) {
    throw;
  } catch (const core::RoomError&) {
    throw ComputerRoomError(path.string() + ": there is no memory to write it");
  } catch (const core::InputError& error) {
    throw core::InputError(path.string() + ": " + error.what());
  }
}

}  // namespace

void check_image_path(const fs::path& path, std::string_view option) {
  check_extension(path);
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
  const std::string extension = lower_extension(path);
  if (extension == ".exr") {
    return exr_of(image);
  }
  if (extension == ".png") {
    return png_file(image.width, image.height, srgb_bytes(image));
  }
  check_extension(path);
  return file_of(path, image);
}

std::string encoded_picture(const fs::path& path, const Channel& channel) {
  core::expect(lower_extension(path) == ".exr", "numbers are kept in EXR files");
  return exr_file({.width = channel.width,
                   .height = channel.height,
                   .channels = {{channel.name, channel.values}},
                   .remarks = channel.remarks});
}

void write_image(const fs::path& path, const Image& image) { write_file(path, encoded_picture(path, image)); }

Image read_image(const fs::path& path, Sandbox sandbox) {
  return PictureReader({.sandbox = sandbox}).read_image(open_picture(path));
}

}  // namespace dmpc::apps
