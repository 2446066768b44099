// PNG files (ISO 15948) with a table of colours: pictures of few colours, without a library.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace dmpc::apps {

/// A colour on the sRGB curve: red, green, blue.
using PaletteColor = std::array<std::uint8_t, 3>;

/// The file's bytes. `indices`: the number of its colour for each pixel, row by row from the top left. Requires a pixel, less
/// than 32,768 in a row, and 1 to 256 colours that have those numbers.
std::string indexed_png(int width, int height, std::span<const std::uint8_t> indices, std::span<const PaletteColor> palette);

}  // namespace dmpc::apps
