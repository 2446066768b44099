// Spheres and cones against a ray in double precision: the oracle's intersection functions for shapes that Embree does not have.
#pragma once

#include <array>
#include <optional>

#include "core/database/database.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// The real roots of a t^2 + 2 b t + c in ascending order, neither by a difference of numbers that are nearly equal (W. Press and
/// others, Numerical Recipes, section 5.6). `quarter` is b^2 - a c. NaN stands for a root that there is not.
std::array<double, 2> quadratic_roots(double a, double b, double c, double quarter);

/// The first of them, `shift` farther along the ray, in (0, t_max) that `accept` takes.
template <class Accept>
std::optional<double> first_root(const std::array<double, 2>& roots, double shift, double t_max, const Accept& accept) {
  for (const double root : roots) {
    const double t = root + shift;
    if (t > 0 && t < t_max && accept(root)) {
      return t;
    }
  }
  return std::nullopt;
}

/// A cone as seen along its axis, which has unit length; the radius changes by `slope` for each unit of height.
struct ConeAxis {
  ConeAxis(const core::Vec3d& from, const core::Vec3d& to_apex, double from_radius, double apex_radius)
      : base(from),
        height(length(to_apex)),
        axis(to_apex * (1 / height)),
        base_radius(from_radius),
        slope((apex_radius - base_radius) / height) {}

  core::Vec3d base;
  double height;
  core::Vec3d axis;
  double base_radius, slope;
};

/// The least distance in (0, t_max) at which `ray` meets the sphere, cone or cylinder `values`, in units of the ray's direction.
/// Works in double precision from the floats of the ray and of the record and shares no code with core's kernels. A negative
/// radius makes only the inside visible. Requires values.kind other than triangle. Thread-safe.
std::optional<double> nearest_on_curved(const core::PrimitiveValues& values, const core::Ray& ray);

/// An axis-aligned box around a primitive: lower x y z, upper x y z; rounded outwards in float.
std::array<float, 6> bounds_of_curved(const core::PrimitiveValues& values);

}  // namespace dmpc::apps
