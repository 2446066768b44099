#include "apps/picture/inset.h"

#include <algorithm>
#include <cstddef>

#include "core/base/expect.h"

namespace dmpc::apps {

void inset(Image& image, int left, int top, const Image& part) {
  core::expect(left >= 0 && top >= 0 && left + part.width <= image.width && top + part.height <= image.height,
               "a picture lies whole within another");
  const auto row_floats = static_cast<std::ptrdiff_t>(part.width) * 3;
  for (int y = 0; y < part.height; ++y) {
    const std::ptrdiff_t to = (static_cast<std::ptrdiff_t>(top + y) * image.width + left) * 3;
    std::copy_n(part.rgb.begin() + y * row_floats, row_floats, image.rgb.begin() + to);
  }
}

}  // namespace dmpc::apps
