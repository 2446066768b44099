#include "apps/picture/color_map.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmpc::apps {

namespace {

constexpr int steps = 400;

double at(int step) { return static_cast<double>(step) / steps; }

double distance(const LabColor& a, const LabColor& b) { return std::hypot(a.lightness - b.lightness, a.a - b.a, a.b - b.b); }

/// Of linear light, by the definition of L*.
double lightness(const core::Color& color) {
  const double y = 0.2126729 * double{color.x} + 0.7151522 * double{color.y} + 0.0721750 * double{color.z};
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

}  // namespace

TEST_CASE("equal steps along the colour map are equally far apart in CIELAB, but where the line bends") {
  double least = 1e9, largest = 0;
  for (int i = 0; i < steps; ++i) {
    const double step = distance(lab_color_map(at(i)), lab_color_map(at(i + 1)));
    least = std::min(least, step);
    largest = std::max(largest, step);
  }
  CHECK(largest < 1.15 * least);
}

TEST_CASE("lightness grows from end to end, from nearly black to nearly white") {
  for (int i = 0; i < steps; ++i) {
    CHECK(lab_color_map(at(i)).lightness < lab_color_map(at(i + 1)).lightness);
  }
  CHECK(lab_color_map(0).lightness < 10);
  CHECK(lab_color_map(1).lightness > 90);
}

TEST_CASE("every colour can be shown, with the lightness that it is meant to have") {
  for (int i = 0; i <= steps; ++i) {
    const core::Color color = color_map(at(i));
    for (std::size_t channel = 0; channel < 3; ++channel) {
      CHECK(color[channel] >= 0);
      CHECK(color[channel] <= 1);
    }
    CHECK(lightness(color) == doctest::Approx(lab_color_map(at(i)).lightness).epsilon(0.005));
  }
}

TEST_CASE("positions beyond the ends are the ends, and what is no number the lower one") {
  CHECK(color_map(-1) == color_map(0));
  CHECK(color_map(2) == color_map(1));
  CHECK(color_map(std::numeric_limits<double>::infinity()) == color_map(1));
  CHECK(color_map(std::numeric_limits<double>::quiet_NaN()) == color_map(0));
}

}  // namespace dmpc::apps
