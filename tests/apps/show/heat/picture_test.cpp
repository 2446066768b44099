#include "apps/show/heat/picture.h"

#include <doctest/doctest.h>

#include <vector>

#include "apps/frontend/picture/color_map.h"
#include "core/picture/heat_kind.h"

namespace dmpc::apps::heat_picture_test {

namespace {

HeatField field(int width, int height, const std::vector<double>& values) {
  return {
      .kind = core::HeatKind::rays, .width = width, .height = height, .values = values, .meaning = "rays traced", .unit = "rays"};
}

core::Color pixel(const Image& image, int x, int y) {
  const std::size_t at = static_cast<std::size_t>(y * image.width + x) * 3;
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

}  // namespace

TEST_CASE("every pixel has its number's colour, at its place above the legend") {
  const Image image = heat_picture(field(3, 2, {1, 2, 3, 3, 2, 1}), "scene");
  CHECK(pixel(image, 0, 0) == color_map(0));
  CHECK(pixel(image, 1, 0) == color_map(0.5));
  CHECK(pixel(image, 0, 1) == color_map(1));
  CHECK(pixel(image, 2, 1) == color_map(0));
  CHECK(pixel(image, 3, 0) == core::Color{1, 1, 1});
  CHECK(image.height > 2 + 40);
  CHECK(image.width >= 240);
}

TEST_CASE("0 is black on a logarithmic scale") {
  const Image image = heat_picture(field(4, 1, {0, 1, 1, 1000}), "");
  CHECK(pixel(image, 0, 0) == core::Color{0, 0, 0});
  CHECK(pixel(image, 1, 0) == color_map(0));
  CHECK(pixel(image, 3, 0) == color_map(1));
}

TEST_CASE("a wide picture keeps its width, and its legend has larger letters") {
  const Image narrow = heat_picture(field(1, 1, {1}), "scene"),
              wide = heat_picture(field(2000, 1, std::vector<double>(2000)), "");
  CHECK(wide.width == 2000);
  CHECK(wide.height > 2 * narrow.height);
}

TEST_CASE("the legend tells different numbers and sources apart") {
  const Image first = heat_picture(field(1, 1, {1}), "a"), other = heat_picture(field(1, 1, {2}), "a");
  CHECK(first.rgb != other.rgb);
  CHECK(first.rgb != heat_picture(field(1, 1, {1}), "b").rgb);
  CHECK(first.rgb == heat_picture(field(1, 1, {1}), "a").rgb);
}

}  // namespace dmpc::apps::heat_picture_test
