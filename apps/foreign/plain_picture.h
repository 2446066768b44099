// Pictures of the two formats that nearly all textures have, by the libraries of these formats alone: OpenImageIO, which decodes
// them by the same, takes a third of a second to load.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dmpc::apps {

/// Integers as the file has them, the first pixel at the top left.
struct RawPicture {
  std::uint32_t width = 0, height = 0;
  int channels = 0;              ///< grey, with alpha or without, or red, green and blue, likewise
  bool has_wide_values = false;  ///< of two bytes, in this machine's order, not of one
  std::vector<std::uint8_t> values;
};

/// Pixels of the largest that is read: beside what those take the start of OpenImageIO is nothing.
inline constexpr std::uint64_t plain_pixels_max = std::uint64_t{1} << 26U;

/// Whether that many pixels, of values of so many bytes, are there and not too many, for a file of so many bytes, either.
bool is_plain_size(std::uint64_t width, std::uint64_t height, std::uint64_t value_bytes, std::uint64_t file_bytes,
                   std::uint64_t pixels_max);

/// A PNG of any colours and depth; palettes and grey of less than 8 bits as bytes, transparent colours as alpha. What chunks
/// say that have nothing to do with that is passed over. Nothing if libpng has any complaint.
std::optional<RawPicture> png_picture(std::span<const std::byte> file, std::uint64_t pixels_max = plain_pixels_max);

/// A JPEG in grey or colours (of three channels). Nothing if it is none, or libjpeg has any complaint.
std::optional<RawPicture> jpeg_picture(std::span<const std::byte> file, std::uint64_t pixels_max = plain_pixels_max);

}  // namespace dmpc::apps
