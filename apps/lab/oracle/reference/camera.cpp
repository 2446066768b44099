#include "apps/lab/oracle/reference/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// In diagonals of the visible scene: double is enough for nearer eyes.
constexpr long double far_eye = 64;

long double lead_to(const core::Box& bounds, const core::Vec3<long double>& eye) {
  if (bounds.empty()) {
    return 0;
  }
  const long double diagonal = length(bounds.high - bounds.low);
  const long double distance = length(core::Vec3<long double>(bounds.center()) - eye);
  return distance > far_eye * diagonal ? distance - diagonal : 0;
}

}  // namespace

ReferenceCamera::ReferenceCamera(const core::View& view, int width, int height, const core::Box& bounds)
    : eye_(view.from), forward_(normalize(Vec3l(view.at) - eye_)), lead_(lead_to(bounds, eye_)), width_(width), height_(height) {
  core::expect(width > 0 && height > 0, "a camera has pixels");
  // The angle spans the centres of the first and the last pixel of the shorter side; a single pixel spans all of it.
  const long double half_angle = view.angle_degrees / 2.0L * std::numbers::pi_v<long double> / 180;
  const long double step = 2 * std::tan(half_angle) / std::max(1, std::min(width, height) - 1);
  const Vec3l right = normalize(cross(forward_, Vec3l(view.up)));
  right_ = right * step;
  down_ = cross(forward_, right) * step;
}

ReferenceRay ReferenceCamera::ray_through(double column, double row) const {
  const long double x = column - (width_ - 1) / 2.0L, y = row - (height_ - 1) / 2.0L;
  const Vec3l towards = forward_ + right_ * x + down_ * y;
  const long double distance = length(towards);
  const Vec3l direction = towards * (1 / distance);
  // The derivatives of the line above (H. Igehy, "Tracing Ray Differentials", SIGGRAPH 1999).
  const auto turned_by = [&](const Vec3l& step) {
    return core::Vec3d((step - direction * dot(step, direction)) * (1 / distance));
  };
  ReferenceRay ray;
  ray.origin = core::Vec3d(eye_ + direction * lead_);
  ray.direction = core::Vec3d(direction);
  ray.cone = static_cast<double>(lead_);
  ray.apart = {turned_by(right_), turned_by(down_)};
  return ray;
}

/// Returns the lesser singular value of the two changes of the direction.
double narrow_angle(const ReferenceRay& ray) {
  const auto& [column, row] = ray.apart;
  const double first = dot(column, column), second = dot(row, row);
  const double less = (first + second) / 2 - std::hypot((first - second) / 2, dot(column, row));
  return std::sqrt(std::max(less, 0.0));
}

}  // namespace dmpc::apps
