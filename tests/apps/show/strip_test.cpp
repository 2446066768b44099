#include "apps/show/strip.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "core/picture/heat_kind.h"

namespace dmpc::apps::strip_test {

namespace {

/// `width` pixels in a row, all white, done at these times.
Image strip_of(const std::vector<double>& done_us, const std::string& source = "") {
  const int width = static_cast<int>(done_us.size());
  Image picture(width, 1);
  picture.rgb.assign(picture.rgb.size(), 1);
  return strip_picture(picture, {.kind = core::HeatKind::done, .width = width, .height = 1, .values = done_us}, 256, source);
}

/// Which of the pixels of a moment, 0 to 5, are there: its columns are as wide as the time below it.
std::string lit(const Image& strip, int moment, int width) {
  const int column = strip.width / 6;
  std::string text;
  for (int x = 0; x < width; ++x) {
    const auto at = static_cast<std::size_t>(4 * strip.width + 4 + moment * column + x) * 3;
    text += strip.rgb[at] == 1 ? '1' : '.';
  }
  return text;
}

}  // namespace

TEST_CASE("each of six moments shows the pixels that are done by then, and the last one all") {
  const Image strip = strip_of({6, 1, 2, 3.1, 5, 0});
  CHECK(lit(strip, 0, 6) == ".1...1");  // what is done at 0 has nothing to do
  CHECK(lit(strip, 1, 6) == ".11..1");
  CHECK(lit(strip, 2, 6) == ".11..1");
  CHECK(lit(strip, 3, 6) == ".111.1");
  CHECK(lit(strip, 4, 6) == ".11111");
  CHECK(lit(strip, 5, 6) == "111111");
}

TEST_CASE("a strip says its times and where they come from") {
  CHECK(strip_of({1, 2}).rgb != strip_of({1000, 2000}).rgb);
  CHECK(strip_of({1, 2}, "a").rgb != strip_of({1, 2}, "b").rgb);
  CHECK(strip_of({1, 2}, std::string(100, 'a')).width > strip_of({1, 2}).width);
}

TEST_CASE("a large picture is shrunk, six of it are no wider than six times 256 pixels with gaps") {
  CHECK(strip_of(std::vector<double>(1024, 1)).width == 6 * (256 + 4) + 4);
}

}  // namespace dmpc::apps::strip_test
