// Writes OpenEXR files: scan lines of 32-bit floats, with lossless compression.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dmpc::apps {

/// A picture that is not stored as a whole.
struct ExrRows {
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< names
  /// Writes the numbers of pixels from `first` on, as many as fit, each pixel's in the channels' order. Several threads call it
  /// at the same time.
  std::function<void(std::size_t first, std::span<float> numbers)> take;
  std::vector<std::pair<std::string, std::string>> remarks;  ///< text attributes
};

/// Returns the file's bytes, which are equal for equal pictures. `threads` compress rows; 0: one per core. Requires at least a
/// pixel and a channel, and distinct names of 1 to 31 bytes.
std::string exr_file(const ExrRows& picture, std::uint32_t threads = 0);

}  // namespace dmpc::apps
