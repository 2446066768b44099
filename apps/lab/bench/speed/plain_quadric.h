// Spheres and cones of a plain renderer, as textbooks have them.
#pragma once

#include "core/base/vec.h"
#include "core/database/database.h"

namespace dmpc::apps {

/// A sphere, cone or cylinder, prepared for many rays, in double precision, since small ones are far away. Source: E. Haines,
/// "Essential Ray Tracing Algorithms", in A. Glassner (ed.), An Introduction to Ray Tracing, 1989.
class PlainQuadric {
 public:
  explicit PlainQuadric(const core::PrimitiveValues& values);

  /// The least distance in (from, to) at which the ray meets it; NaN if there is none.
  double distance(const core::Vec3d& origin, const core::Vec3d& direction, double from, double to) const {
    return is_cone_ ? cone_distance(origin, direction, from, to) : sphere_distance(origin, direction, from, to);
  }
  /// The outward normal, of unit length, next to a point, which is moved to the surface.
  core::Vec3d normal_at(core::Vec3d& point) const;
  /// Of a sphere; 0 of others.
  double sphere_radius() const { return is_cone_ ? 0 : radius_; }

 private:
  double sphere_distance(const core::Vec3d& origin, const core::Vec3d& direction, double from, double to) const;
  double cone_distance(const core::Vec3d& origin, const core::Vec3d& direction, double from, double to) const;

  core::Vec3d base_, axis_;  ///< centre; `axis_` has unit length
  double radius_, height_ = 0, slope_ = 0;
  bool is_cone_, is_inside_only_, is_flat_ = false;
};

}  // namespace dmpc::apps
