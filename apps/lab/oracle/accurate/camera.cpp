#include "apps/lab/oracle/accurate/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/expect.h"

namespace dmpc::apps {

AccurateCamera::AccurateCamera(const core::View& view, int width, int height)
    : eye_(view.from), forward_(normalize(view.at - view.from)), width_(width), height_(height) {
  core::expect(width > 0 && height > 0, "a camera has pixels");
  // The angle spans the centres of the first and the last pixel of the shorter side; a single pixel spans all of it.
  const double half_angle = view.angle_degrees / 2 * std::numbers::pi / 180;
  const double step = 2 * std::tan(half_angle) / std::max(1, std::min(width, height) - 1);
  const core::Vec3d right = normalize(cross(forward_, view.up));
  right_ = right * step;
  down_ = cross(forward_, right) * step;
}

AccurateRay AccurateCamera::ray_through(double column, double row) const {
  const double x = column - (width_ - 1) / 2.0, y = row - (height_ - 1) / 2.0;
  AccurateRay ray;
  ray.origin = eye_;
  const core::Vec3d towards = forward_ + right_ * x + down_ * y;
  const double distance = length(towards);
  ray.direction = towards * (1 / distance);
  // The derivatives of the line above (H. Igehy, "Tracing Ray Differentials", SIGGRAPH 1999).
  const auto turned_by = [&](const core::Vec3d& step) {
    return (step - ray.direction * dot(step, ray.direction)) * (1 / distance);
  };
  ray.apart = {turned_by(right_), turned_by(down_)};
  return ray;
}

/// The lesser singular value of the two changes of the direction.
double narrow_angle(const AccurateRay& ray) {
  const auto& [column, row] = ray.apart;
  const double first = dot(column, column), second = dot(row, row);
  const double less = (first + second) / 2 - std::hypot((first - second) / 2, dot(column, row));
  return std::sqrt(std::max(less, 0.0));
}

}  // namespace dmpc::apps
