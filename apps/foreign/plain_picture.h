// Pictures of the formats that nearly all textures, and dmpc's own pictures, have, by the libraries of these formats alone:
// OpenImageIO, which decodes them by the same, takes a third of a second to load.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dmpc::apps {

/// Numbers as the file has them, the first pixel at the top left.
struct RawPicture {
  std::uint32_t width = 0, height = 0;
  int channels = 0;             ///< grey, with alpha or without, or red, green and blue, likewise
  std::size_t value_bytes = 1;  ///< 1 or 2: integers, in this machine's order; 4: floats
  std::vector<std::uint8_t> values;
};

/// The functions below read a picture from its beginning; without values they only read the data before these. This is the
/// maximum number of pixels: for larger pictures the start of OpenImageIO takes little time in comparison, and it needs half
/// of the memory.
inline constexpr std::uint64_t plain_pixels_max = std::uint64_t{1} << 24U;

/// Whether this many pixels, of `value_bytes` each, are in a file of `file_bytes` and not more than `pixels_max`.
bool is_plain_size(std::uint64_t width, std::uint64_t height, std::uint64_t value_bytes, std::uint64_t file_bytes,
                   std::uint64_t pixels_max);

/// A PNG of any colours and depth; palettes and grey of less than 8 bits as bytes, transparent colours as alpha. What chunks
/// say that have nothing to do with that is passed over. Nothing if libpng has any complaint.
std::optional<RawPicture> png_picture(std::span<const std::byte> file, std::uint64_t pixels_max = plain_pixels_max,
                                      bool has_values = true);

/// A JPEG in grey or colours (of three channels). Nothing if it is none, or libjpeg has any complaint.
std::optional<RawPicture> jpeg_picture(std::span<const std::byte> file, std::uint64_t pixels_max = plain_pixels_max,
                                       bool has_values = true);

/// An EXR of one part in rows, whose channels are R, G and B, with A or without, or Y, of floats or halves, which become floats.
/// Nothing if it is none, if some of it is no number, or if OpenEXR has any complaint.
std::optional<RawPicture> exr_picture(std::span<const std::byte> file, std::uint64_t pixels_max = plain_pixels_max,
                                      bool has_values = true);

}  // namespace dmpc::apps
