#include "apps/picture/glyphs.h"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

namespace dmpc::apps::glyphs_test {

namespace {

constexpr core::Color white{1, 1, 1};

/// The text in white on black.
Image drawn(const std::string& text, int width = 40, int height = 10) {
  Image image(width, height);
  draw_text(image, {1, 1, 1}, text, white);
  return image;
}

int dots(const Image& image) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    count += image.rgb[i] > 0 ? 1 : 0;
  }
  return count;
}

}  // namespace

TEST_CASE("every letter, digit and mark of a legend looks different") {
  const std::string all = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 .,:-+/_()?";
  std::set<std::vector<float>> pictures;
  for (const char letter : all) {
    pictures.insert(drawn({letter}).rgb);
  }
  CHECK(pictures.size() == all.size());
  CHECK(drawn("?").rgb == drawn("\x80").rgb);
}

TEST_CASE("text is written in capitals, one glyph beside the other") {
  CHECK(drawn("node 7").rgb == drawn("NODE 7").rgb);
  CHECK(dots(drawn("LL")) == 2 * dots(drawn("L")));
  CHECK(text_width("", 3) == 0);
  CHECK(text_width("A", 3) == 15);
  CHECK(text_width("AB", 2) == 22);
}

TEST_CASE("what lies outside the image is cut off") {
  Image image(4, 4);
  draw_text(image, {-3, -3, 1}, "HHH", white);
  draw_text(image, {100, 100, 2}, "H", white);
  fill(image, -5, 2, 7, 1, white);
  CHECK(image.rgb[(2 * 4 + 1) * 3] == 1);
  Image nothing;
  draw_text(nothing, {}, "H", white);
  CHECK(nothing.rgb.empty());
}

TEST_CASE("a dot of two pixels is four pixels") {
  Image image(40, 20);
  draw_text(image, {0, 0, 2}, "L", white);
  CHECK(dots(image) == 4 * dots(drawn("L")));
}

}  // namespace dmpc::apps::glyphs_test
