// From a place on the picture to a primary ray in double precision.
#pragma once

#include "apps/lab/oracle/accurate/ray.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// The pinhole that core/picture/camera.h defines, in world coordinates.
class AccurateCamera {
 public:
  /// Requires width, height > 0.
  AccurateCamera(const core::View& view, int width, int height);

  /// Through the point (column, row), in pixels; whole numbers are the centres of pixels, (0, 0) the first one's.
  AccurateRay ray_through(double column, double row) const;
  int width() const { return width_; }
  int height() const { return height_; }
  const core::Vec3d& eye() const { return eye_; }

 private:
  core::Vec3d eye_, forward_, right_, down_;  ///< right_, down_: one pixel's step in the plane at distance 1
  int width_, height_;
};

}  // namespace dmpc::apps
