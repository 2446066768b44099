// PNG files (ISO 15948) as dmpc writes them: 8 bits a channel with the sRGB curve.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace dmpc::apps {

/// A picture whose bytes are never all in memory.
struct PngRows {
  int width = 0, height = 0;
  /// Writes three bytes for each pixel from `first` on, as many as fit. Several threads call it at the same time.
  std::function<void(std::size_t first, std::span<std::uint8_t> rgb)> take;
};

/// Returns the file's bytes, which are equal for equal pictures. `threads` filter its rows; 0: one per core. Requires a pixel.
std::string png_file(const PngRows& picture, std::uint32_t threads = 0);

}  // namespace dmpc::apps
