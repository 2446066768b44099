// Computes primary rays from points on the picture in double precision.
#pragma once

#include "apps/lab/oracle/reference/ray.h"
#include "core/base/box.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// The pinhole that core/picture/camera/camera.h defines, in world coordinates.
class ReferenceCamera {
 public:
  /// `bounds` are those of the visible scene. Rays of an eye that is far from them start just before them, computed in long
  /// double, since doubles at the eye could distinguish neither its rays nor what they meet. Empty: all rays start at the eye.
  /// Requires width, height > 0.
  ReferenceCamera(const core::View& view, int width, int height, const core::Box& bounds = {});

  /// Returns the ray through the point (column, row), in pixels; whole numbers are the centres of pixels, and (0, 0) is the first
  /// one's.
  ReferenceRay ray_through(double column, double row) const;
  int width() const { return width_; }
  int height() const { return height_; }
  core::Vec3d eye() const { return core::Vec3d(eye_); }
  /// Returns the start of the ray through the picture's middle.
  core::Vec3d start() const { return core::Vec3d(eye_ + forward_ * lead_); }

 private:
  using Vec3l = core::Vec3<long double>;

  Vec3l eye_, forward_, right_, down_;  ///< right_, down_: one pixel's step in the plane at distance 1
  long double lead_ = 0;                ///< distance from the eye at which rays start
  int width_, height_;
};

}  // namespace dmpc::apps
