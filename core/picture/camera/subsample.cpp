#include "core/picture/camera/subsample.h"

#include <algorithm>

namespace dmpc::core {
namespace {

/// The middles of the full intervals of length `step` in [0, size), or the middle of [0, size) if it is shorter.
std::vector<std::uint32_t> middles(int size, int step) {
  std::vector<std::uint32_t> found;
  for (int at = std::min(step, size) / 2; at < size && (found.empty() || at - step / 2 + step <= size); at += step) {
    found.push_back(static_cast<std::uint32_t>(at));
  }
  return found;
}

}  // namespace

std::vector<std::uint32_t> subsampled_pixels(int width, int height, int subsample) {
  std::vector<std::uint32_t> pixels;
  for (const std::uint32_t y : middles(height, subsample)) {
    for (const std::uint32_t x : middles(width, subsample)) {
      pixels.push_back(y * static_cast<std::uint32_t>(width) + x);
    }
  }
  return pixels;
}

}  // namespace dmpc::core
