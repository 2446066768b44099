// PNG files (ISO 15948), as dmpc writes them: 8 bits a channel on the sRGB curve.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace dmpc::apps {

/// The file's bytes, the same for the same picture. `rgb`: three bytes a pixel, row by row from the top left. `threads`: how many
/// filter its rows; 0: one for each core. Requires a pixel.
std::string png_file(int width, int height, std::span<const std::uint8_t> rgb, std::uint32_t threads = 0);

}  // namespace dmpc::apps
