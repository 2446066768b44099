#include "apps/picture/png_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "tests/apps/modules/read_file.h"

namespace dmpc::tests::png_file_test {

namespace {

using Bytes = std::vector<std::uint8_t>;

std::string png_file(int width, int height, const Bytes& rgb, std::uint32_t threads = 0) {
  const auto take = [&rgb](std::size_t first, std::span<std::uint8_t> some) {
    std::ranges::copy(std::span(rgb).subspan(3 * first, some.size()), some.begin());
  };
  return apps::png_file({width, height, take}, threads);
}

/// value(column, row, channel) for each.
Bytes painted(int width, int height, const std::function<int(int, int, int)>& value) {
  Bytes rgb;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      for (int channel = 0; channel < 3; ++channel) {
        rgb.push_back(static_cast<std::uint8_t>(value(column, row, channel)));
      }
    }
  }
  return rgb;
}

/// What each filter is best at, and what none is.
std::vector<Bytes> paintings(int width, int height) {
  const auto noise = [](int column, int row, int channel) {
    return static_cast<int>(core::mix(static_cast<std::uint64_t>((column * 1000 + row) * 3 + channel)) & 0xffU);
  };
  return {painted(width, height, noise),
          painted(width, height, [](int, int, int) { return 200; }),
          painted(width, height, [](int column, int, int channel) { return 3 * column + 50 * channel; }),
          painted(width, height, [&](int column, int, int channel) { return noise(column, 0, channel); }),
          painted(width, height, [](int column, int row, int) { return column * column / 8 + row * row / 8; }),
          painted(width, height, [&](int column, int row, int channel) { return noise(column / 9, row / 9, channel) + column; })};
}

}  // namespace

TEST_CASE("OpenImageIO reads the bytes that were written, whichever filter the rows take") {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {64, 40}, {255, 3}}) {
    CAPTURE(width);
    CAPTURE(height);
    for (const Bytes& rgb : paintings(width, height)) {
      const ReadFile file("a.png", png_file(width, height, rgb));
      CHECK((file.spec().width == width && file.spec().height == height && file.spec().nchannels == 3));
      CHECK(file.values<std::uint8_t>(OIIO::TypeDesc::UINT8) == rgb);
    }
  }
}

TEST_CASE("a PNG says that it is of the sRGB curve") {
  const ReadFile file("a.png", png_file(1, 1, Bytes{1, 2, 3}));
  CHECK(file.spec().get_string_attribute("oiio:ColorSpace") == "sRGB");
}

TEST_CASE("the same picture is the same file, and no larger than OpenImageIO's by more than a twentieth") {
  for (const Bytes& rgb : paintings(128, 96)) {
    const std::string file = png_file(128, 96, rgb);
    CHECK(file == png_file(128, 96, rgb));
    std::vector<unsigned char> theirs;
    OIIO::Filesystem::IOVecOutput into_theirs(theirs);
    const auto output = OIIO::ImageOutput::create("a.png");
    REQUIRE((output && output->set_ioproxy(&into_theirs)));
    REQUIRE(output->open("a.png", OIIO::ImageSpec(128, 96, 3, OIIO::TypeDesc::UINT8)));
    REQUIRE((output->write_image(OIIO::TypeDesc::UINT8, rgb.data()) && output->close()));
    CHECK(file.size() < theirs.size() + theirs.size() / 20 + 100);
  }
}

TEST_CASE("a PNG has the same bytes whatever the number of threads that filter it") {
  for (const Bytes& rgb : paintings(50, 170)) {
    const std::string file = png_file(50, 170, rgb, 1);
    CHECK(file == png_file(50, 170, rgb, 2));
    CHECK(file == png_file(50, 170, rgb, 5));
    CHECK(ReadFile("a.png", file).values<std::uint8_t>(OIIO::TypeDesc::UINT8) == rgb);
  }
}

TEST_CASE("a PNG whose packed rows take several chunks is read") {
  const Bytes noise = paintings(900, 500).front();
  const std::string file = png_file(900, 500, noise);
  CHECK(file.size() > std::size_t{1} << 20U);
  CHECK(ReadFile("a.png", file).values<std::uint8_t>(OIIO::TypeDesc::UINT8) == noise);
}

TEST_CASE("a PNG without pixels is a bug") { CHECK_THROWS_AS(png_file(0, 1, Bytes{}), core::InternalError); }

}  // namespace dmpc::tests::png_file_test
