// The colours of plots.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "apps/frontend/show/page/web_part.h"

namespace dmpc::tests::palette_test {

namespace {

using Light = std::array<double, 3>;

/// The light of "#rrggbb".
Light linear_light(const std::string& color) {
  Light light{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double value = std::stoi(color.substr(1 + 2 * channel, 2), nullptr, 16) / 255.0;
    light[channel] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  }
  return light;
}

Light seen_by(const std::array<Light, 3>& matrix, const Light& light) {
  Light product{};
  for (std::size_t row = 0; row < 3; ++row) {
    product[row] = matrix[row][0] * light[0] + matrix[row][1] * light[1] + matrix[row][2] * light[2];
  }
  return product;
}

/// CIE 1976 L*a*b* under D65.
Light lab(Light light) {
  for (double& value : light) {
    value = std::clamp(value, 0.0, 1.0);
  }
  Light xyz = seen_by({{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}}, light);
  xyz[0] /= 0.9505;
  xyz[2] /= 1.089;
  const auto curve = [](double value) { return value > 0.008856 ? std::cbrt(value) : 7.787 * value + 16.0 / 116; };
  return {116 * curve(xyz[1]) - 16, 500 * (curve(xyz[0]) - curve(xyz[1])), 200 * (curve(xyz[1]) - curve(xyz[2]))};
}

/// Those of palette.js, which dmpc.plotting has, too.
std::vector<std::string> page_colors() {
  const std::string script = apps::html::page_script.text;
  std::size_t at = script.find("seriesColors = ["), end = script.find(']', at);
  std::vector<std::string> colors;
  while ((at = script.find('#', at)) < end) {
    colors.push_back(script.substr(at, 7));
    ++at;
  }
  return colors;
}

double color_distance(const Light& a, const Light& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

// The matrices of G. Machado, M. Oliveira, L. Fernandes, "A Physiologically-based Model for Simulation of Color Vision
// Deficiency" (2009), for the strongest degree of each.
TEST_CASE("people who lack one kind of cones can tell the colours of plots apart") {
  constexpr double clearly_apart = 15;  // a difference of 2.3 is just seen
  const std::array<std::array<Light, 3>, 4> eyes = {{
      {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
      {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
      {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}},
  }};
  const std::vector<std::string> colors = page_colors();
  REQUIRE(colors.size() == 8);
  for (const auto& eye : eyes) {
    for (std::size_t a = 0; a < colors.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        CAPTURE(colors[a]);
        CAPTURE(colors[b]);
        CHECK(color_distance(lab(seen_by(eye, linear_light(colors[a]))), lab(seen_by(eye, linear_light(colors[b])))) >
              clearly_apart);
      }
    }
  }
}

}  // namespace dmpc::tests::palette_test
