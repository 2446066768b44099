// OpenEXR files, as dmpc writes them: scan lines of 32-bit floats, packed without loss.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dmpc::apps {

/// A picture of which nobody holds all numbers.
struct ExrRows {
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< names
  /// Writes the numbers of pixels from the `first` on, as many as fit, each pixel's in the channels' order.
  /// Several threads call it at once.
  std::function<void(std::size_t first, std::span<float> numbers)> take;
  std::vector<std::pair<std::string, std::string>> remarks;  ///< attributes that are texts
};

/// The file's bytes, the same for the same picture. `threads`: how many pack its rows; 0: one for each core. Requires a pixel, a
/// channel, and names of 1 to 31 bytes, no two alike.
std::string exr_file(const ExrRows& picture, std::uint32_t threads = 0);

}  // namespace dmpc::apps
