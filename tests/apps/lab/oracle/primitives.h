// The oracle tests' little language: primitives and rays in one line each.
#pragma once

#include "core/database/database.h"
#include "core/record/ray.h"

namespace dmpc::tests {

using core::Vec3f;

inline core::PrimitiveValues triangle(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  return {core::PrimitiveKind::triangle, {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z}};
}
inline core::PrimitiveValues sphere(const Vec3f& center, float radius) {
  return {core::PrimitiveKind::sphere, {center.x, center.y, center.z, radius}};
}
inline core::PrimitiveValues cone(const Vec3f& base, float base_radius, const Vec3f& apex, float apex_radius) {
  return {core::PrimitiveKind::cone, {base.x, base.y, base.z, base_radius, apex.x, apex.y, apex.z, apex_radius}};
}
inline core::Ray ray(const Vec3f& origin, const Vec3f& direction) {
  core::Ray result;
  result.origin = origin;
  result.direction = direction;
  return result;
}
inline core::Ray shadow_ray(const Vec3f& origin, const Vec3f& direction, float t_max) {
  core::Ray result = ray(origin, direction);
  result.t_max = t_max;
  result.kind = core::RayKind::shadow;
  return result;
}

}  // namespace dmpc::tests
