#include "core/database/tree/overlap.h"

#include <algorithm>
#include <cmath>

#include "core/base/expect.h"
#include "core/record/curved_values.h"

namespace dmpc::core {
namespace {

void include_disc(Box& box, const Vec3d& center, const Vec3d& axis, double radius) {
  const double squared = dot(axis, axis);
  for (std::size_t i = 0; i < 3; ++i) {
    const double reach = radius * std::sqrt(std::max(0.0, 1.0 - axis[i] * axis[i] / squared));
    box.low[i] = std::min(box.low[i], center[i] - reach);
    box.high[i] = std::max(box.high[i], center[i] + reach);
  }
}

double absolute_sum(const Vec3d& axis, const Vec3d& half) {
  return std::fabs(axis.x) * half.x + std::fabs(axis.y) * half.y + std::fabs(axis.z) * half.z;
}

/// Whether `axis` separates the box about the origin from the triangle p q r.
bool separates(const Vec3d& axis, const Vec3d& half, const Vec3d& p, const Vec3d& q, const Vec3d& r) {
  const double a = dot(axis, p), b = dot(axis, q), c = dot(axis, r), reach = absolute_sum(axis, half);
  return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
}

/// Whether a bound that lies `above` the box's face is outside the box; one in the face is not.
bool leaves(double above) { return above > 0.0; }

/// The distance of a point to the segment from p to q, in a plane.
double segment_distance(double x, double y, double px, double py, double qx, double qy) {
  const double dx = qx - px, dy = qy - py;
  const double s = std::clamp(((x - px) * dx + (y - py) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  const double off_x = x - px - s * dx, off_y = y - py - s * dy;
  return std::sqrt(off_x * off_x + off_y * off_y);
}

}  // namespace

Box other_bounds_of(const PrimitiveValues& primitive) {
  Box box;
  switch (primitive.kind) {
    case PrimitiveKind::triangle:
      expect(false, "a triangle's bounds are its coordinates'");
      break;
    case PrimitiveKind::sphere: {
      const double radius = std::fabs(double{primitive.value[3]});
      box.include(primitive.vector(0));
      box = box.padded({radius, radius, radius});
      break;
    }
    case PrimitiveKind::cone: {
      const ConeFloats cone({primitive.value.data(), 1, 0});
      include_disc(box, cone.base, cone.axis, cone.base_radius);
      include_disc(box, cone.apex, cone.axis, cone.apex_radius);
      break;
    }
    case PrimitiveKind::instance:
      box.include(primitive.vector(0));
      box.include(primitive.vector(3));
      break;
  }
  return box;
}

Bounds rounded_bounds_of(const PrimitiveValues& primitive) {
  return primitive.kind == PrimitiveKind::triangle ? triangle_bounds_of(primitive) : Bounds::around(other_bounds_of(primitive));
}

Overlap::Overlap(const PrimitiveValues& primitive)
    : kind_(primitive.kind), bounds_(bounds_of(primitive)), a_(primitive.vector(0)) {
  switch (kind_) {
    case PrimitiveKind::triangle:
      b_ = primitive.vector(3);
      c_ = primitive.vector(6);
      normal_ = cross(b_ - a_, c_ - a_);
      break;
    case PrimitiveKind::sphere:
      radius_ = std::fabs(double{primitive.value[3]});
      break;
    case PrimitiveKind::cone:
      b_ = ConeFloats({primitive.value.data(), 1, 0}).axis;
      radius_ = std::fabs(double{primitive.value[3]});
      apex_radius_ = std::fabs(double{primitive.value[7]});
      break;
    case PrimitiveKind::instance:
      expect(false, "boxes of instances are not listed in cells");
  }
}

bool Overlap::touches(const Vec3d& center, const Vec3d& half) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (leaves(bounds_.low[axis] - (center[axis] + half[axis])) || leaves(center[axis] - half[axis] - bounds_.high[axis])) {
      return false;
    }
  }
  return kind_ == PrimitiveKind::triangle ? triangle(center, half)
         : kind_ == PrimitiveKind::sphere ? sphere(center, half)
                                          : cone(center, half);
}

bool Overlap::triangle(const Vec3d& center, const Vec3d& half) const {
  const Vec3d p = a_ - center, q = b_ - center, r = c_ - center;
  if (separates(normal_, half, p, q, r)) {
    return false;
  }
  for (const Vec3d& e : {q - p, r - q, p - r}) {
    if (separates({0, -e.z, e.y}, half, p, q, r) || separates({e.z, 0, -e.x}, half, p, q, r) ||
        separates({-e.y, e.x, 0}, half, p, q, r)) {
      return false;
    }
  }
  return true;
}

bool Overlap::sphere(const Vec3d& center, const Vec3d& half) const {
  double nearest = 0, farthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double distance = std::fabs(a_[axis] - center[axis]);
    const double gap = std::max(0.0, distance - half[axis]), reach = distance + half[axis];
    nearest += gap * gap;
    farthest += reach * reach;
  }
  return nearest <= radius_ * radius_ && farthest >= radius_ * radius_;
}

bool Overlap::cone(const Vec3d& center, const Vec3d& half) const {
  const double size = length(b_);
  const Vec3d axis = b_ * (1.0 / size), from_base = center - a_;
  const double height = dot(from_base, axis), distance = length(from_base - axis * height);
  return segment_distance(height, distance, 0.0, radius_, size, apex_radius_) <= length(half) * (1.0 + 1e-9);
}

}  // namespace dmpc::core
