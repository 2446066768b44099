#include "apps/frontend/picture/indexed_png.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "apps/picture/image_file.h"
#include "core/base/expect.h"
#include "core/base/srgb.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::indexed_png_test {

namespace {

using Bytes = std::vector<std::uint8_t>;

const std::vector<PaletteColor> red_and_white = {{255, 0, 0}, {255, 255, 255}};

/// Number of pixels that OpenImageIO reads differently.
std::size_t wrong_pixels(int width, int height, const Bytes& indices, const std::vector<PaletteColor>& colors) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "picture.png", indexed_png(width, height, indices, colors));
  const Image read = read_image(folder / "picture.png");
  REQUIRE(read.width == width);
  REQUIRE(read.height == height);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const PaletteColor& color = colors[indices[i]];
    for (std::size_t channel = 0; channel < color.size(); ++channel) {
      wrong += core::srgb_byte(read.rgb[3 * i + channel]) == color[channel] ? 0 : 1;
    }
  }
  return wrong;
}

}  // namespace

TEST_CASE("a picture of one pixel has the bytes that the format's text gives it") {
  const std::string png = indexed_png(1, 1, Bytes{0}, std::vector<PaletteColor>{{0, 0, 0}});
  CHECK(png.starts_with(std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\x03\0\0\0", 29)));
  CHECK(png.ends_with(std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12)));
}

TEST_CASE("other programs' libraries read each pixel's colour, whether rows are alike, mostly of one colour, or neither") {
  for (const std::size_t step : {1U, 3U, 7U, 500U, 501U, 1009U, 20'000U}) {
    CAPTURE(step);
    Bytes indices(500 * 300);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      indices[i] = static_cast<std::uint8_t>(i % step == 0 ? 1 : 0);
    }
    CHECK(wrong_pixels(500, 300, indices, red_and_white) == 0);
  }
}

TEST_CASE("of 256 colours in any order each pixel is read, in an eighth more bytes than pixels at most") {
  std::vector<PaletteColor> grey(256);
  for (std::size_t i = 0; i < grey.size(); ++i) {
    grey[i].fill(static_cast<std::uint8_t>(i));
  }
  std::mt19937 random(1);
  Bytes indices(300 * 200);
  for (std::uint8_t& index : indices) {
    index = static_cast<std::uint8_t>(random());
  }
  CHECK(wrong_pixels(300, 200, indices, grey) == 0);
  CHECK(indexed_png(300, 200, indices, grey).size() < 300 * 200 * 9 / 8 + 1000);
}

TEST_CASE("a map of a million places, a hundredth of which is not the least, takes less than a tenth of a megabyte") {
  Bytes indices(1024 * 1024);
  std::mt19937 random(2);
  for (std::size_t i = 0; i < indices.size() / 100; ++i) {
    indices[random() % indices.size()] = 1;
  }
  CHECK(indexed_png(1024, 1024, indices, red_and_white).size() < 100'000);
}

TEST_CASE("a pixel without a colour and a picture without pixels are mistakes") {
  CHECK_THROWS_AS(indexed_png(1, 1, Bytes{2}, red_and_white), core::InternalError);
  CHECK_THROWS_AS(indexed_png(1, 2, Bytes{0}, red_and_white), core::InternalError);
  CHECK_THROWS_AS(indexed_png(0, 0, Bytes{}, red_and_white), core::InternalError);
}

}  // namespace dmpc::apps::indexed_png_test
