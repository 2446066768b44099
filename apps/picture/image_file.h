// Pictures in files: EXR and PNG by the libraries of these formats, others by a library of all formats, which is slow to load.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/reader/confinement.h"

namespace dmpc::apps {

/// Linear RGB radiance, row by row from the top left, three floats a pixel.
struct Image {
  Image() = default;
  /// Makes a black image. Requires width, height >= 0.
  Image(int image_width, int image_height)
      : width(image_width),
        height(image_height),
        rgb(static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height) * 3) {}

  int width = 0, height = 0;
  std::vector<float> rgb;
  std::vector<std::pair<std::string, std::string>> remarks = {};  ///< names and texts, kept if the format is EXR
};

/// Numbers of a pixel, row by row from the top left, with remarks for their reader.
struct Channels {
  int width = 0, height = 0;
  std::string layer = {};          ///< what goes before their names, and a point, in a file with a picture
  std::vector<std::string> names;  ///< of each number of a pixel
  std::vector<float> values = {};
  std::vector<std::pair<std::string, std::string>> remarks = {};  ///< names and texts, kept with the picture if the format can
};

/// A picture whose pixels are never all in memory.
struct ImageRows {
  int width = 0, height = 0;
  /// Writes three floats of linear radiance for each pixel from `first` on, as many as fit. Several threads call it at the same
  /// time.
  std::function<void(std::size_t first, std::span<float> rgb)> take;
  std::vector<std::pair<std::string, std::string>> remarks = {};  ///< as those of Image
  std::vector<const Channels*> layers = {};                       ///< kept if the format is EXR
};

/// Returns the picture with all its pixels.
Image image_of(const ImageRows& rows);

/// Throws core::InputError unless a picture can be written at `path`: the extension is .exr, .png, or one that OpenImageIO
/// writes, `path` is no pipe or device, check_output_path() accepts it, and the format holds a picture of one pixel. Throws
/// InstallationError or ComputerCapacityError if the writer cannot be loaded. It stays loaded, so writing cannot fail for that
/// reason after a render. `option` names the option that gave the path, for the message.
void check_image_path(const std::filesystem::path& path, std::string_view option);

/// Writes the picture atomically. EXR, TIFF and HDR get 32-bit linear floats (HDR its own shared exponents); every other format
/// gets 8 bits, clamped to 0..1, with the sRGB curve. Throws core::InputError on failure.
void write_image(const std::filesystem::path& path, const Image& image);

/// Returns what write_image() would write to `path`, without writing it.
std::string encoded_picture(const std::filesystem::path& path, const Image& image);
std::string encoded_picture(const std::filesystem::path& path, const ImageRows& image);

/// Returns the bytes of the channels alone, as 32-bit floats. Requires a path that ends in .exr, and all numbers of each pixel.
std::string encoded_picture(const std::filesystem::path& path, const Channels& channels);

/// Reads the first three channels (a single channel is repeated). Floats are taken as linear radiance; integers as sRGB and made
/// linear. Throws core::InputError if there is no such picture, or if its reader is less confined than `sandbox`.
Image read_image(const std::filesystem::path& path, Sandbox sandbox = Sandbox::available);

}  // namespace dmpc::apps
