#include "dataflow/rays/pixel_order.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/trace/bundle.h"

namespace pixel_order_test {

using dmpc::dataflow::PixelOrder;

namespace {

std::vector<std::uint32_t> pixels_of(const PixelOrder& order, std::uint32_t count) {
  std::vector<std::uint32_t> pixels(count);
  for (std::uint32_t place = 0; place < count; ++place) {
    pixels[place] = order.pixel_at(place);
  }
  return pixels;
}

}  // namespace

TEST_CASE("row by row a pixel's place is its number") { CHECK(pixels_of({}, 4) == std::vector<std::uint32_t>{0, 1, 2, 3}); }

TEST_CASE("in squares a bundle's pixels are a square, and squares follow each other from left to right") {
  static_assert(PixelOrder::side * PixelOrder::side == dmpc::core::bundle_rays_max);
  const std::vector<std::uint32_t> pixels = pixels_of(PixelOrder::squares(8, 8), 64);
  const std::vector<std::uint32_t> first = {0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19, 24, 25, 26, 27};
  for (std::uint32_t i = 0; i < 16; ++i) {
    CHECK(pixels[i] == first[i]);
    CHECK(pixels[16 + i] == first[i] + 4);
    CHECK(pixels[32 + i] == first[i] + 32);
  }
}

TEST_CASE("what is left of squares on the right and at the bottom is gone through by rows, too") {
  CHECK(pixels_of(PixelOrder::squares(6, 5), 30) == std::vector<std::uint32_t>{0,  1,  2,  3,  6,  7,  8,  9,  12, 13,
                                                                               14, 15, 18, 19, 20, 21, 4,  5,  10, 11,
                                                                               16, 17, 22, 23, 24, 25, 26, 27, 28, 29});
}

TEST_CASE("every pixel of a picture of any size has one place") {
  for (std::uint32_t width = 1; width <= 13; ++width) {
    for (std::uint32_t height = 1; height <= 13; ++height) {
      std::vector<int> times(width * height);
      for (const std::uint32_t pixel : pixels_of(PixelOrder::squares(width, height), width * height)) {
        REQUIRE(pixel < times.size());
        ++times[pixel];
      }
      CHECK(times == std::vector<int>(width * height, 1));
    }
  }
}

}  // namespace pixel_order_test
