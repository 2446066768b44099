#include "apps/picture/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmpc::apps {

namespace {

/// Chosen so that the hue turns one way, from blue to yellow, and that all between them can be shown on a screen.
constexpr std::array<LabColor, 7> knots = {
    {{8, 11, -26}, {20, 25, -42}, {33, 42, -38}, {46, 57, -15}, {59, 56, 18}, {72, 34, 46}, {92, -6, 46}}};

double distance(const LabColor& from, const LabColor& to) {
  const double lightness = to.lightness - from.lightness, a = to.a - from.a, b = to.b - from.b;
  return std::sqrt(lightness * lightness + a * a + b * b);
}

LabColor between(const LabColor& from, const LabColor& to, double share) {
  return {from.lightness + share * (to.lightness - from.lightness), from.a + share * (to.a - from.a),
          from.b + share * (to.b - from.b)};
}

double length_of_line() {
  double length = 0;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    length += distance(knots[i - 1], knots[i]);
  }
  return length;
}

/// The inverse of CIE's f.
double without_cube_root(double f) {
  constexpr double delta = 6.0 / 29;
  return f > delta ? f * f * f : 3 * delta * delta * (f - 4.0 / 29);
}

float channel(double x, double y, double z) { return static_cast<float>(std::clamp(x + y + z, 0.0, 1.0)); }

}  // namespace

LabColor lab_color_map(double position) {
  static const double length = length_of_line();
  double left = (position > 0 ? std::min(position, 1.0) : 0.0) * length;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double piece = distance(knots[i - 1], knots[i]);
    if (left <= piece) {
      return between(knots[i - 1], knots[i], left / piece);
    }
    left -= piece;
  }
  return knots.back();
}

core::Color color_map(double position) {
  const LabColor lab = lab_color_map(position);
  const double f = (lab.lightness + 16) / 116;
  const double x = 0.95047 * without_cube_root(f + lab.a / 500);
  const double y = without_cube_root(f);
  const double z = 1.08883 * without_cube_root(f - lab.b / 200);
  return {channel(3.2404542 * x, -1.5371385 * y, -0.4985314 * z), channel(-0.9692660 * x, 1.8760108 * y, 0.0415560 * z),
          channel(0.0556434 * x, -0.2040259 * y, 1.0572252 * z)};
}

}  // namespace dmpc::apps
