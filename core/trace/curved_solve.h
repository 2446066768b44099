// Where a ray meets a sphere or a cone, in double: code without calls and branches, so that compilers vectorise loops over rays.
#pragma once

#include <cmath>
#include <limits>

#include "core/base/vec.h"
#include "core/record/curved_values.h"
#include "core/trace/primitive.h"

namespace dmpc::core {

/// Where a ray's line crosses a surface, in ascending order; not finite if nowhere.
struct Crossings {
  double first, second;

  /// How near to the ray's start, `shift` before them, the nearer one is.
  double nearest_to_start(double shift) const {
    const double one = std::fabs(first + shift), other = std::fabs(second + shift);
    return other < one ? other : one;
  }
};

/// A ray's line and a sphere, solved around the line's nearest point to the centre.
struct SphereLine {
  SphereLine(const Vec3d& center, double signed_radius, const Vec3d& origin, const Vec3d& d)
      : to_origin(origin - center), radius(signed_radius) {
    const double a = dot(d, d);
    middle = -dot(to_origin, d) / a;
    const Vec3d nearest = to_origin + d * middle;
    const double rest = radius * radius - dot(nearest, nearest);
    const double half = rest >= 0.0 ? std::sqrt(rest / a) : std::numeric_limits<double>::quiet_NaN();
    crossings.first = middle - half;
    crossings.second = middle + half;
  }

  /// The nearest visible crossing with t > 0, or `missed`.
  double nearest_visible() const {
    const double outside = radius > 0.0 ? crossings.first : double{missed};
    const double visible = outside > 0.0 ? outside : crossings.second;
    return visible > 0.0 ? visible : double{missed};
  }

  Vec3d to_origin;
  double radius, middle = 0;
  Crossings crossings{};
};

/// A cone between its base and its apex, or a flat one, whose axis is stored as it is.
struct ConeValues {
  Vec3d base, axis;
  double base_radius, apex_radius;  ///< without their signs
};
inline ConeValues cone_values(const CurvedValues& values) {
  const auto [base, base_radius] = values.four(0);
  const auto [apex, apex_radius] = values.four(4);
  return {base, values.is_flat() ? apex : apex - base, std::fabs(base_radius), std::fabs(apex_radius)};
}

/// A ray's line and a cone, as quantities that are linear in t, from the line's nearest point to the base on, or for a flat cone
/// from its crossing of the base's plane: X(t) = across + t * across_rate, r(t), and h(t), in [0, 1] on the cone. A flat cone is
/// almost a plane, as is its mirror image beyond the apex, which can be distinguished only where the ray crosses that plane.
struct ConeLine {
  ConeLine(const ConeValues& cone, bool is_flat, const Vec3d& origin, const Vec3d& direction) : d(direction), axis(cone.axis) {
    const Vec3d from_base = origin - cone.base;
    const double axis_squared = dot(axis, axis), along = dot(d, axis), widening = cone.apex_radius - cone.base_radius;
    const double widest = cone.base_radius < cone.apex_radius ? cone.apex_radius : cone.base_radius;
    const bool crosses_flat = is_flat && std::fabs(along) * widest > axis_squared;
    shift = crosses_flat ? -dot(from_base, axis) / along : -dot(from_base, d) / dot(d, d);
    const Vec3d start = from_base + d * shift;
    height = dot(start, axis) / axis_squared;
    height_rate = along / axis_squared;
    across = start - axis * height;
    across_rate = d - axis * height_rate;
    radius = cone.base_radius + widening * height;
    radius_rate = widening * height_rate;
    taper = widening / axis_squared;
    solve(dot(across_rate, across_rate) - radius_rate * radius_rate, dot(across, across_rate) - radius * radius_rate,
          dot(across, across) - radius * radius);
  }

  /// The nearest crossing with t > 0 on the cone, or `missed`.
  double nearest_visible(bool inside_only) const {
    return is_visible(roots.first, inside_only)    ? roots.first + shift
           : is_visible(roots.second, inside_only) ? roots.second + shift
                                                   : double{missed};
  }

  Vec3d d, axis, across, across_rate;
  double shift = 0;  ///< t where the line's quantities begin
  double radius = 0, radius_rate = 0, height = 0, height_rate = 0, taper = 0;
  Crossings roots{};  ///< crossings less `shift`

 private:
  static bool is_number(double x) { return std::fabs(x) < std::numeric_limits<double>::infinity(); }

  /// The roots of a t^2 + 2 b t + c; not finite if there is none.
  void solve(double a, double b, double c) {
    const double q = -(b + std::copysign(std::sqrt(b * b - a * c), b));
    const double one = (a != 0.0 ? q : c) / (a != 0.0 ? a : q), ratio = c / q, other = q != 0.0 ? ratio : one;
    const bool is_other = is_number(other), are_both = is_number(one) & is_other;
    const double only = is_other ? other : one, first = are_both ? one : only, second = are_both ? other : only;
    roots.first = first > second ? second : first;
    roots.second = first > second ? first : second;
  }
  bool is_visible(double root, bool inside_only) const {
    const double up = height + height_rate * root;
    return (root + shift > 0.0) & (up >= 0.0) & (up <= 1.0) && (!inside_only || is_leaving(root));
  }
  /// d.N > 0 for N the outward normal at a root.
  bool is_leaving(double root) const {
    const Vec3d normal = across + across_rate * root - axis * ((radius + radius_rate * root) * taper);
    return dot(d, normal) > 0.0;
  }
};

/// Only rays from the eye may start on a surface: others start off it. Such a ray has a crossing nearer to its start than this,
/// however much it grazes the surface.
inline constexpr double next_to_start = 0x1p-13;
}  // namespace dmpc::core
