// How many pixels a picture has.
#pragma once

#include <cstdint>

namespace dmpc::apps {

/// Pixels of one picture, whether the scene or the command line asks for them.
inline constexpr std::int64_t picture_pixels_max = std::int64_t{1} << 28;

struct Resolution {
  int width = 0, height = 0;  ///< both above 0
};

}  // namespace dmpc::apps
