#include "apps/formats/whole_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/base/box.h"
#include "core/base/elementary.h"
#include "core/scene/frame.h"

namespace dmpc::apps {

using core::Vec3d;

BoundingSphere sphere_around(const IndexedVertices& vertices) {
  core::Box box;
  std::vector<std::uint8_t> has_vertex(vertices.points.size());  // a point is looked at once, in the order of the vertices
  for (const std::uint32_t index : vertices.indices) {
    if (has_vertex[index] == 0) {
      has_vertex[index] = 1;
      box.include(vertices.points[index]);
    }
  }
  if (box.empty()) {
    return {{}, 1};
  }
  BoundingSphere bounds{box.center(), 0};
  double square = 0;
  for (std::size_t i = 0; i < has_vertex.size(); ++i) {
    const Vec3d offset = vertices.points[i] - bounds.center;
    square = has_vertex[i] != 0 ? std::max(square, dot(offset, offset)) : square;
  }
  bounds.radius = std::sqrt(square);
  return bounds;
}

SceneAxes axes_of(const UpAxis& up) {
  static constexpr std::array<SceneAxes, 3> all = {
      {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}};
  const SceneAxes& axes = all[up.axis];
  // Half a turn about the way to the front.
  return up.is_negative ? SceneAxes{Vec3d{} - axes.right, Vec3d{} - axes.up, axes.front} : axes;
}

core::View whole_view(const BoundingSphere& bounds, const UpAxis& up) {
  const SceneAxes frame = axes_of(up);
  core::View view{.at = bounds.center, .up = frame.up};
  const Vec3d towards_eye = normalize(frame.right * 0.6 + frame.up * 0.5 + frame.front);
  view.from = bounds.center + towards_eye * (bounds.radius / core::sin_degrees(view.angle_degrees / 2));
  return view;
}

std::vector<core::PointLight> plain_lights(const BoundingSphere& bounds, const core::View& view) {
  constexpr double distance_radii = 1000, key = 0.8, fill = 0.3;
  const core::GridAxes screen = core::screen_axes(view);
  const Vec3d towards_key = normalize(screen[0] * 0.7 + screen[1] + screen[2]);
  return {{bounds.center + towards_key * (distance_radii * bounds.radius), {key, key, key}, true},
          {view.from, {fill, fill, fill}, true}};
}

}  // namespace dmpc::apps
