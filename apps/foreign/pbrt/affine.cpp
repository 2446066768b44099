#include "apps/foreign/pbrt/affine.h"

#include <cmath>

#include "core/base/elementary.h"

namespace dmpc::apps::pbrt {

using core::Vec3d;

std::optional<Transform> inverse_of(const Transform& map) {
  const auto& [a, b, c] = map.rows;
  const Vec3d bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double determinant = dot(a, bc);
  if (!std::isfinite(determinant) || !std::isnormal(determinant)) {
    return std::nullopt;
  }
  Transform result{{{{bc.x, ca.x, ab.x}, {bc.y, ca.y, ab.y}, {bc.z, ca.z, ab.z}}}, {}};
  for (Vec3d& row : result.rows) {
    row = row * (1 / determinant);
  }
  result.shift = -result.direction(map.shift);
  const bool is_usable =
      is_finite(result.rows[0]) && is_finite(result.rows[1]) && is_finite(result.rows[2]) && is_finite(result.shift);
  return is_usable ? std::optional(result) : std::nullopt;
}

Transform translation(const Vec3d& by) { return {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, by}; }

Transform scaling(const Vec3d& by) { return {{{{by.x, 0, 0}, {0, by.y, 0}, {0, 0, by.z}}}, {}}; }

Transform rotation(double degrees, const Vec3d& axis) {
  const Vec3d a = normalize(axis);
  const double s = core::sin_degrees(degrees), c = core::cos_degrees(degrees), d = 1 - c;
  return {{{{a.x * a.x * d + c, a.x * a.y * d - a.z * s, a.x * a.z * d + a.y * s},
            {a.y * a.x * d + a.z * s, a.y * a.y * d + c, a.y * a.z * d - a.x * s},
            {a.z * a.x * d - a.y * s, a.z * a.y * d + a.x * s, a.z * a.z * d + c}}},
          {}};
}

std::optional<Transform> look_at(const Vec3d& from, const Vec3d& at, const Vec3d& up) {
  const Vec3d ahead = at - from;
  const double distance = length(ahead);
  if (!(distance > 0) || !std::isfinite(distance)) {
    return std::nullopt;
  }
  const Vec3d z = ahead * (1 / distance), right = cross(up, z);
  const double across = length(right);
  if (!(across > 0) || !std::isfinite(across)) {
    return std::nullopt;
  }
  const Vec3d x = right * (1 / across), y = cross(z, x);
  return Transform{{{x, y, z}}, {-dot(x, from), -dot(y, from), -dot(z, from)}};
}

}  // namespace dmpc::apps::pbrt
