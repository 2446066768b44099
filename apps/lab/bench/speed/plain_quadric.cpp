#include "apps/lab/bench/speed/plain_quadric.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/record/curved_values.h"

namespace dmpc::apps {

namespace {

using core::Vec3d;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The first root of a t^2 + 2 b t + c in (from, to) that `accept` takes.
template <class Accept>
double first_root(double a, double b, double c, double from, double to, const Accept& accept) {
  const double quarter = b * b - a * c;
  if (!(quarter >= 0)) {
    return none;
  }
  const double q = -b - std::copysign(std::sqrt(quarter), b);
  const double one = q / a, other = c / q, first = std::min(one, other), second = std::max(one, other);
  return first > from && first < to && accept(first) ? first : second > from && second < to && accept(second) ? second : none;
}

}  // namespace

PlainQuadric::PlainQuadric(const core::PrimitiveValues& values) : is_cone_(values.kind == core::PrimitiveKind::cone) {
  const core::CurvedValues exact = values.curved();
  base_ = exact.vector(0);
  radius_ = std::fabs(exact.value(3));
  is_inside_only_ = std::signbit(exact.value(3));
  if (is_cone_) {
    height_ = length(exact.axis());
    axis_ = exact.axis() * (1 / height_);
    slope_ = (std::fabs(exact.value(7)) - radius_) / height_;
    is_flat_ = exact.is_flat();
  }
}

double PlainQuadric::sphere_distance(const Vec3d& origin, const Vec3d& direction, double from, double to) const {
  const Vec3d way = origin - base_;
  return first_root(dot(direction, direction), dot(way, direction), dot(way, way) - radius_ * radius_, from, to,
                    [&](double t) { return !is_inside_only_ || dot(way + direction * t, direction) > 0; });
}

/// A flat cone is solved from where the ray crosses its base's plane.
double PlainQuadric::cone_distance(const Vec3d& origin, const Vec3d& direction, double from, double to) const {
  const double climb = dot(direction, axis_);
  const double shift = is_flat_ && climb != 0 ? dot(base_ - origin, axis_) / climb : 0;
  const Vec3d way = origin + direction * shift - base_;
  const double up = dot(way, axis_), radius = radius_ + slope_ * up, widening = slope_ * climb;
  const Vec3d across = way - axis_ * up, turn = direction - axis_ * climb;
  const auto accept = [&](double t) {
    const double at = up + t * climb;
    return at >= 0 && at <= height_ &&
           (!is_inside_only_ || dot(across + turn * t, direction) > slope_ * (radius + t * widening) * climb);
  };
  return shift + first_root(dot(turn, turn) - widening * widening, dot(across, turn) - radius * widening,
                            dot(across, across) - radius * radius, from - shift, to - shift, accept);
}

Vec3d PlainQuadric::normal_at(Vec3d& point) const {
  const Vec3d way = point - base_;
  const double up = dot(way, axis_);
  const Vec3d outward = normalize(way - axis_ * up);
  if (!is_flat_) {
    point = base_ + axis_ * up + outward * (radius_ + slope_ * up);
  }
  return is_cone_ ? normalize(outward - axis_ * slope_) : outward;
}

}  // namespace dmpc::apps
