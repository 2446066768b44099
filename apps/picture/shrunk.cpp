#include "apps/picture/shrunk.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace dmpc::apps {

Image shrunk(const Image& image, int side_max) {
  const int step = (std::max(image.width, image.height) + side_max - 1) / side_max;
  if (step <= 1) {
    return image;
  }
  const auto at = [](const Image& of, int x, int y) {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(of.width) + static_cast<std::size_t>(x)) * 3;
  };
  Image small((image.width + step - 1) / step, (image.height + step - 1) / step);
  std::vector<float> count(small.rgb.size());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t from = at(image, x, y), to = at(small, x / step, y / step);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        small.rgb[to + channel] += image.rgb[from + channel];
        count[to + channel] += 1;
      }
    }
  }
  std::transform(small.rgb.begin(), small.rgb.end(), count.begin(), small.rgb.begin(), std::divides());
  return small;
}

}  // namespace dmpc::apps
