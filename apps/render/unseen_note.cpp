#include "apps/render/unseen_note.h"

#include <cmath>

#include "apps/edge/line/number_text.h"
#include "apps/formats/whole_view.h"
#include "apps/scene/staging.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

std::string rounded_text(const Vec3d& point) { return rounded(point.x) + "," + rounded(point.y) + "," + rounded(point.z); }

/// A single point has a sphere, too, or its camera would stand in it.
BoundingSphere sphere_around(const core::Box& bounds) {
  const double radius = 0.5 * length(bounds.high - bounds.low);
  return {bounds.center(), radius > 0 ? radius : 1};
}

}  // namespace

UpAxis up_of(const core::View& view) {
  UpAxis up{0, view.up.x < 0};
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::fabs(view.up[axis]) > std::fabs(view.up[up.axis])) {
      up = {axis, view.up[axis] < 0};
    }
  }
  return up;
}

std::string unseen_note(const core::Box& bounds, const UpAxis& up) {
  core::expect(!bounds.empty(), "a scene that may be seen has bounds");
  const core::View view = whole_view(sphere_around(bounds), up);
  return "the camera sees nothing of the scene, which lies between " + rounded_text(bounds.low) + " and " +
         rounded_text(bounds.high) +
         ": the whole of it is in view by --camera=" + text_of(CameraChoice{view.from, view.at, view.up, view.angle_degrees});
}

}  // namespace dmpc::apps
