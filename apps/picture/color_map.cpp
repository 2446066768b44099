#include "apps/picture/color_map.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// So many colours are asked for once; between them a straight line is as good.
constexpr std::size_t color_count = 256;
using Colors = std::array<core::Color, color_count>;

/// OpenImageIO has them as linear light.
Colors make_colors() {
  OIIO::ImageBuf positions(OIIO::ImageSpec(color_count, 1, 1, OIIO::TypeDesc::FLOAT)), image;
  for (std::size_t i = 0; i < color_count; ++i) {
    const float position = static_cast<float>(i) / (color_count - 1);
    positions.setpixel(static_cast<int>(i), 0, OIIO::cspan<float>(&position, 1));
  }
  const bool is_known = OIIO::ImageBufAlgo::color_map(image, positions, 0, "inferno", {}, 1);
  core::expect(is_known, "OpenImageIO knows the map inferno");
  Colors colors;
  for (std::size_t i = 0; i < color_count; ++i) {
    std::array<float, 3> color{};
    image.getpixel(static_cast<int>(i), 0, color.data(), 3);
    colors[i] = {color[0], color[1], color[2]};
  }
  return colors;
}

}  // namespace

core::Color color_map(double position) {
  static const Colors colors = make_colors();
  const double place = (position > 0 ? std::min(position, 1.0) : 0.0) * (color_count - 1);
  const auto below = static_cast<std::size_t>(place), above = std::min(below + 1, color_count - 1);
  const auto share = static_cast<float>(place - static_cast<double>(below));
  return colors[below] * (1 - share) + colors[above] * share;
}

}  // namespace dmpc::apps
