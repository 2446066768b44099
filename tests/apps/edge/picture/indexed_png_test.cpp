#include "apps/edge/picture/indexed_png.h"

#include <doctest/doctest.h>

#include <vector>

#include "apps/picture/image_file.h"
#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::indexed_png_test {

namespace {

using Bytes = std::vector<std::uint8_t>;

const std::vector<PaletteColor> red_and_white = {{255, 0, 0}, {255, 255, 255}};

}  // namespace

TEST_CASE("a picture of one pixel has the bytes that the format's text gives it") {
  const std::string png = indexed_png(1, 1, Bytes{0}, std::vector<PaletteColor>{{0, 0, 0}});
  CHECK(png.starts_with(std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\x03\0\0\0", 29)));
  CHECK(png.ends_with(std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12)));
}

TEST_CASE("other programs' libraries read each pixel's colour, of pictures of more than one block, too") {
  const tests::TemporaryFolder folder;
  Bytes indices(500 * 300);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    indices[i] = static_cast<std::uint8_t>(i % 3 == 0 ? 1 : 0);
  }
  tests::write_text(folder / "picture.png", indexed_png(500, 300, indices, red_and_white));
  const Image read = read_image(folder / "picture.png");
  REQUIRE(read.width == 500);
  REQUIRE(read.height == 300);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    wrong += read.rgb[3 * i] == 1 && read.rgb[3 * i + 1] == static_cast<float>(indices[i]) ? 0 : 1;
  }
  CHECK(wrong == 0);
}

TEST_CASE("a pixel without a colour and a picture without pixels are mistakes") {
  CHECK_THROWS_AS(indexed_png(1, 1, Bytes{2}, red_and_white), core::InternalError);
  CHECK_THROWS_AS(indexed_png(1, 2, Bytes{0}, red_and_white), core::InternalError);
  CHECK_THROWS_AS(indexed_png(0, 0, Bytes{}, red_and_white), core::InternalError);
}

}  // namespace dmpc::apps::indexed_png_test
