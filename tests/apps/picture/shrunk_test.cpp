#include "apps/picture/shrunk.h"

#include <doctest/doctest.h>

#include <cstddef>

namespace dmpc::apps::shrunk_test {

TEST_CASE("a picture that is too large is shrunk to means of squares") {
  Image image(5, 2);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    image.rgb[i] = static_cast<float>(i);
  }
  const Image small = shrunk(image, 3);
  CHECK(small.width == 3);
  CHECK(small.height == 1);
  CHECK(small.rgb[0] == (0 + 3 + 15 + 18) / 4.0F);
  CHECK(small.rgb[8] == (14 + 29) / 2.0F);  // the last column is half a square
  CHECK(shrunk(image, 5).rgb == image.rgb);
}

}  // namespace dmpc::apps::shrunk_test
