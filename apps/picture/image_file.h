// Pictures in files: EXR and PNG by the libraries of these formats, others by one of all formats, which takes long to load.
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
  /// Black. Requires width, height >= 0.
  Image(int image_width, int image_height)
      : width(image_width),
        height(image_height),
        rgb(static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height) * 3) {}

  int width = 0, height = 0;
  std::vector<float> rgb;
  std::vector<std::pair<std::string, std::string>> remarks = {};  ///< names and texts, kept where the format is EXR
};

/// A picture of which nobody holds all pixels.
struct ImageRows {
  int width = 0, height = 0;
  /// Writes three floats of linear radiance for each pixel from the `first` on, as many as fit. Several threads
  /// call it at once.
  std::function<void(std::size_t first, std::span<float> rgb)> take;
  std::vector<std::pair<std::string, std::string>> remarks = {};  ///< as those of an image
};

/// All its pixels.
Image image_of(const ImageRows& rows);

/// One number a pixel, row by row from the top left, with what a reader should know of them.
struct Channel {
  int width = 0, height = 0;
  std::string name;
  std::vector<float> values;
  std::vector<std::pair<std::string, std::string>> remarks;  ///< names and texts, kept with the picture where the format can
};

/// Throws core::InputError unless a picture can be written at `path`: the extension is .exr, .png, or one that OpenImageIO
/// writes, `path` is no pipe or device, a file can be made there as check_output_path() says, and the format holds a picture of
/// one pixel; InstallationError or ComputerCapacityError if what would write it cannot be loaded. Then it is, so nothing is left
/// to fail for that after a render. `option` names the option that gave it, for the message.
void check_image_path(const std::filesystem::path& path, std::string_view option);

/// Writes the picture whole or not at all. EXR, TIFF and HDR get 32-bit linear floats (HDR its own shared exponents); every other
/// format gets 8 bits, clamped to 0..1, with the sRGB curve. Throws core::InputError if that fails.
void write_image(const std::filesystem::path& path, const Image& image);

/// What write_image() would write to `path`, which is not touched.
std::string encoded_picture(const std::filesystem::path& path, const Image& image);
std::string encoded_picture(const std::filesystem::path& path, const ImageRows& image);

/// The bytes of the channel alone, as 32-bit floats. Requires a path that ends in .exr, and a number for each pixel.
std::string encoded_picture(const std::filesystem::path& path, const Channel& channel);

/// Reads the first three channels (one channel is taken thrice). Floats are taken as linear radiance; integers as sRGB and made
/// linear. Throws core::InputError if there is no such picture, or if its reader is confined by less than `sandbox`.
Image read_image(const std::filesystem::path& path, Sandbox sandbox = Sandbox::available);

}  // namespace dmpc::apps
