#include "core/picture/disc.h"

#include <cmath>

#include "core/base/elementary.h"

namespace dmpc::core {
namespace {

constexpr double quarter_of_pi = 0.785398163397448310;

}  // namespace

DiscPlace on_disc(const SamplePair& pair) {
  const double a = 2.0 * pair.x - 1.0, b = 2.0 * pair.y - 1.0;
  const bool is_beside = std::fabs(a) > std::fabs(b);
  const double radius = is_beside ? a : b, ratio = radius == 0.0 ? 0.0 : (is_beside ? b : a) / radius;
  const double along = radius * cos_radians(quarter_of_pi * ratio), aside = radius * sin_radians(quarter_of_pi * ratio);
  return is_beside ? DiscPlace{along, aside, radius * radius} : DiscPlace{aside, along, radius * radius};
}

Vec3d about_axis(const Vec3d& axis, double x, double y, double along) {
  const double sign = std::copysign(1.0, axis.z), scale = -1.0 / (sign + axis.z), mixed = axis.x * axis.y * scale;
  const Vec3d first{1.0 + sign * axis.x * axis.x * scale, sign * mixed, -sign * axis.x};
  const Vec3d second{mixed, sign + axis.y * axis.y * scale, -axis.y};
  return first * x + second * y + axis * along;
}

}  // namespace dmpc::core
