// The resolution of a picture.
#pragma once

#include <cstdint>

namespace dmpc::apps {

/// The maximum number of pixels, whether the scene or the command line sets them.
inline constexpr std::int64_t picture_pixels_max = std::int64_t{1} << 28;

struct Resolution {
  int width = 0, height = 0;  ///< both above 0
};

}  // namespace dmpc::apps
