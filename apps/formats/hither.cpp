#include "apps/formats/hither.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "apps/edge/line/number_text.h"
#include "core/base/elementary.h"
#include "core/scene/frame.h"

namespace dmpc::apps {

namespace {

using core::Vec3d;

/// A side of what is looked through: inside where the height is not below 0.
struct Plane {
  Vec3d normal;  ///< of unit length
  double offset = 0;

  double height_of(const Vec3d& point) const { return dot(normal, point) + offset; }
};

/// What lies between the eye, the hither plane and the four sides of the picture; the eye is the origin.
std::array<Plane, 6> sides_of(const core::View& view) {
  const core::GridAxes screen = core::screen_axes(view);
  const Vec3d forward = -screen[2];
  const double pixel = 2 * core::tan_degrees(view.angle_degrees / 2) / std::max(1, std::min(view.width, view.height) - 1);
  const double right = pixel * view.width / 2, up = pixel * view.height / 2;
  return {{{forward, 0},
           {-forward, view.hither},
           {normalize(forward * right + screen[0]), 0},
           {normalize(forward * right - screen[0]), 0},
           {normalize(forward * up + screen[1]), 0},
           {normalize(forward * up - screen[1]), 0}}};
}

/// The part of a polygon on the inner side (I. Sutherland, G. Hodgman, "Reentrant Polygon Clipping", 1974).
std::vector<Vec3d> cut(const std::vector<Vec3d>& polygon, const Plane& plane) {
  std::vector<Vec3d> inner;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double at_from = plane.height_of(from), at_to = plane.height_of(to);
    if (at_from > 0) {
      inner.push_back(from);
    }
    if ((at_from > 0) != (at_to > 0)) {
      inner.push_back(from + (to - from) * (at_from / (at_from - at_to)));
    }
  }
  return inner;
}

class Hither {
 public:
  explicit Hither(const core::Scene& scene) : scene_(scene), sides_(sides_of(scene.view)) {}

  bool is_before(const core::Object& object) const {
    switch (object.kind) {
      case core::ObjectKind::sphere: {
        const core::Sphere& sphere = scene_.spheres[object.first];
        return has_part_of(sphere.center, std::fabs(sphere.radius));
      }
      case core::ObjectKind::cone: {
        const core::Cone& cone = scene_.cones[object.first];
        const double radius = std::max(std::fabs(cone.base_radius), std::fabs(cone.apex_radius));
        return has_part_of((cone.base + cone.apex) * 0.5, length(cone.apex - cone.base) / 2 + radius);
      }
      default:
        return has_part_of(object);
    }
  }

 private:
  bool has_part_of(const Vec3d& center, double radius) const {
    const Vec3d middle = center - scene_.view.from;
    return std::all_of(sides_.begin(), sides_.end(), [&](const Plane& side) { return side.height_of(middle) > -radius; });
  }
  bool has_part_of(const core::Object& object) const {
    std::vector<Vec3d> polygon;
    for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
      polygon.push_back(scene_.vertices[object.first + i] - scene_.view.from);
    }
    for (const Plane& side : sides_) {
      polygon = cut(polygon, side);
    }
    return !polygon.empty();
  }

  const core::Scene& scene_;
  std::array<Plane, 6> sides_;
};

}  // namespace

std::uint64_t objects_before_hither(const core::Scene& scene) {
  if (!(scene.view.hither > 0)) {
    return 0;
  }
  const Hither hither(scene);
  return static_cast<std::uint64_t>(std::count_if(scene.objects.begin(), scene.objects.end(),
                                                  [&](const core::Object& object) { return hither.is_before(object); }));
}

std::string hither_note(const core::Scene& scene) {
  const std::uint64_t count = objects_before_hither(scene);
  return count == 0
             ? ""
             : scene.name + ": hither " + shortest(scene.view.hither) + " of v (view) is read and ignored: the picture shows " +
                   counted(count, "object") + " of which all or a part is nearer to the eye than that";
}

}  // namespace dmpc::apps
