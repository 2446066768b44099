#include "apps/edge/picture/color_map.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/srgb.h"

namespace dmpc::apps::picture_color_map_test {

namespace {

constexpr int steps = 400;

double at(int step) { return static_cast<double>(step) / steps; }

/// The lightness of linear light, by the definition of L*.
double lightness(const core::Color& color) {
  const double y = 0.2126729 * double{color.x} + 0.7151522 * double{color.y} + 0.0721750 * double{color.z};
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

}  // namespace

TEST_CASE("lightness grows from end to end in steps that look alike, from black to nearly white") {
  for (int i = 0; i < steps; ++i) {
    const double step = lightness(color_map(at(i + 1))) - lightness(color_map(at(i)));
    CHECK(step > 0);
    CHECK(step < 2 * (lightness(color_map(1)) - lightness(color_map(0))) / steps);
  }
  CHECK(lightness(color_map(0)) < 1);
  CHECK(lightness(color_map(1)) > 90);
}

TEST_CASE("every colour can be shown") {
  for (int i = 0; i <= steps; ++i) {
    const core::Color color = color_map(at(i));
    for (std::size_t channel = 0; channel < 3; ++channel) {
      CHECK(color[channel] >= 0);
      CHECK(color[channel] <= 1);
    }
  }
}

TEST_CASE("the colours are those that people know as inferno") {
  CHECK(core::srgb_byte(color_map(0.5).x) == 188);  // #bc3754
  CHECK(core::srgb_byte(color_map(0.5).y) == 55);
  CHECK(core::srgb_byte(color_map(0.5).z) == 84);
}

TEST_CASE("positions beyond the ends are the ends, and what is no number the lower one") {
  CHECK(color_map(-1) == color_map(0));
  CHECK(color_map(2) == color_map(1));
  CHECK(color_map(std::numeric_limits<double>::infinity()) == color_map(1));
  CHECK(color_map(std::numeric_limits<double>::quiet_NaN()) == color_map(0));
}

}  // namespace dmpc::apps::picture_color_map_test
