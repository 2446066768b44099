// Skies of pictures, made up.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/vec.h"
#include "core/scene/sky_texels.h"

namespace dmpc::tests {

/// Blue above, a bright horizon, earth below, darker to one side, and a sun of 2x2 texels: of `width` x `width` / 2 texels, three
/// floats each. No two neighbours are alike.
inline std::vector<float> sunny_sky(std::uint32_t width, float sun = 200) {
  const std::uint32_t height = width / 2, sun_column = width / 3, sun_row = height / 5;
  std::vector<float> rgb;
  for (std::uint32_t row = 0; row < height; ++row) {
    const float up = 1 - 2 * (static_cast<float>(row) + 0.5F) / static_cast<float>(height);
    for (std::uint32_t column = 0; column < width; ++column) {
      const float side = static_cast<float>(column) / static_cast<float>(width);
      const bool is_sun = column / 2 == sun_column / 2 && row / 2 == sun_row / 2;
      const float light = (up > 0 ? 1.2F - 0.8F * up : 0.2F + 0.1F * up) * (0.75F + 0.25F * side) + (is_sun ? sun : 0);
      rgb.insert(rgb.end(), {light * (up > 0 ? 0.6F : 1.0F), light * 0.8F, light * (up > 0 ? 1.0F : 0.6F)});
    }
  }
  return rgb;
}

inline core::SkyTexels sunny_texels(std::uint32_t width, float sun = 200) {
  return core::sky_texels(width, width / 2, sunny_sky(width, sun));
}

/// So many texels of one light, except for one.
inline core::SkyTexels one_bright_texel(std::uint32_t width, std::uint32_t column, std::uint32_t row, float light, float others) {
  std::vector<float> rgb(std::size_t{width} * (width / 2) * 3, others);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    rgb[(std::size_t{row} * width + column) * 3 + channel] = light;
  }
  return core::sky_texels(width, width / 2, rgb);
}

}  // namespace dmpc::tests
