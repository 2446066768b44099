// Writes PNG files (ISO 15948) with a palette, without a library.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace dmpc::apps {

/// A colour on the sRGB curve: red, green, blue.
using PaletteColor = std::array<std::uint8_t, 3>;

/// The file's bytes. `indices`: a palette index per pixel, row by row from the top left. Requires at least one pixel, less than
/// 32,768 in a row, 1 to 256 colours, and valid indices.
std::string indexed_png(int width, int height, std::span<const std::uint8_t> indices, std::span<const PaletteColor> palette);

}  // namespace dmpc::apps
