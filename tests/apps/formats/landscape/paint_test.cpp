#include "apps/formats/landscape/paint.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps::paint_test {

TEST_CASE("a picture of the ground has colours everywhere, whatever its size") {
  for (const int side : {1, 15, 16, 17, 40}) {
    const Image image = ground_picture(side);
    CHECK(image.width == side);
    CHECK(image.height == side);
    CHECK(*std::min_element(image.rgb.begin(), image.rgb.end()) > 0);
  }
}

TEST_CASE("the ground is painted the same every time, and not alike everywhere") {
  const Image image = ground_picture(64);
  CHECK(image.rgb == ground_picture(64).rgb);
  CHECK(std::count(image.rgb.begin(), image.rgb.end(), image.rgb.front()) < 10);
}

TEST_CASE("how many rows are painted is told until all are, which changes no colour") {
  std::vector<std::uint64_t> reported;
  const Image image = ground_picture(300, [&reported](std::uint64_t done, std::uint64_t total) {
    CHECK(total == 300);
    reported.push_back(done);
  });
  CHECK(reported == std::vector<std::uint64_t>{256, 300});
  CHECK(image.rgb == ground_picture(300).rgb);
}

TEST_CASE("a picture without texels is refused") { CHECK_THROWS_AS(ground_picture(0), core::InternalError); }

}  // namespace dmpc::apps::paint_test
