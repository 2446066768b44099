// PNG files (ISO 15948), as dmpc writes them: 8 bits a channel on the sRGB curve.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace dmpc::apps {

/// A picture of which nobody holds all bytes.
struct PngRows {
  int width = 0, height = 0;
  /// Writes three bytes for each pixel from the `first` on, as many as fit. Several threads call it at once.
  std::function<void(std::size_t first, std::span<std::uint8_t> rgb)> take;
};

/// The file's bytes, the same for the same picture. `threads`: how many filter its rows; 0: one for each core. Requires a pixel.
std::string png_file(const PngRows& picture, std::uint32_t threads = 0);

}  // namespace dmpc::apps
