#include "apps/formats/whole_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/base/box.h"
#include "core/base/elementary.h"
#include "core/scene/frame.h"
#include "core/scene/placing.h"

namespace dmpc::apps {

using core::Vec3d;

namespace {

/// The points of a scene's vertices, each once for each place in which it stands, and the box around them.
class PlacedPoints {
 public:
  PlacedPoints(const IndexedVertices& vertices, const std::vector<core::Object>& objects, const core::Instances& instances)
      : points_(vertices.points), places_(instances.places), is_own_(vertices.points.size()) {
    std::uint32_t next = 0;
    for (const core::SharedMesh& mesh : instances.meshes) {
      const core::Object &front = objects[mesh.first], &back = objects[mesh.end - 1];
      add_own(vertices, next, front.first);
      next = back.first + back.vertex_count;
      add_shared(vertices, front.first, next);
    }
    add_own(vertices, next, static_cast<std::uint32_t>(vertices.indices.size()));
    for_each_placed([this](const Vec3d& point) { box_.include(point); },
                    [this](const core::Box& reach) { return !box_.holds(reach.low) || !box_.holds(reach.high); });
  }

  const core::Box& box() const { return box_; }

  /// Calls `take` with each, but of those placed with none of a place whose box `counts` does not hold for.
  template <class Take, class Counts>
  void for_each(const Take& take, const Counts& counts) const {
    for (std::size_t i = 0; i < is_own_.size(); ++i) {
      if (is_own_[i] != 0) {
        take(points_[i]);
      }
    }
    for_each_placed(take, counts);
  }

 private:
  template <class Take, class Counts>
  void for_each_placed(const Take& take, const Counts& counts) const {
    for (const core::Instance& place : places_) {
      if (!counts(reach_of(boxes_[place.mesh], place.world))) {
        continue;
      }
      for (const std::uint32_t point : shared_[place.mesh]) {
        take(place.world.point(points_[point]));
      }
    }
  }

  /// A point is looked at once, in the order of the vertices.
  void add_own(const IndexedVertices& vertices, std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t i = first; i < end; ++i) {
      const std::uint32_t point = vertices.indices[i];
      if (std::exchange(is_own_[point], std::uint8_t{1}) == 0) {
        box_.include(points_[point]);
      }
    }
  }

  void add_shared(const IndexedVertices& vertices, std::uint32_t first, std::uint32_t end) {
    std::vector<std::uint32_t> list(vertices.indices.begin() + first, vertices.indices.begin() + end);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    core::Box& box = boxes_.emplace_back();
    for (const std::uint32_t point : list) {
      box.include(points_[point]);
    }
    shared_.push_back(std::move(list));
  }

  const std::vector<Vec3d>& points_;
  const std::vector<core::Instance>& places_;
  core::Box box_;
  std::vector<std::uint8_t> is_own_;                ///< by point
  std::vector<std::vector<std::uint32_t>> shared_;  ///< points of each mesh
  std::vector<core::Box> boxes_;                    ///< around them
};

}  // namespace

BoundingSphere sphere_around(const IndexedVertices& vertices, const std::vector<core::Object>& objects,
                             const core::Instances& instances, std::span<const core::Sphere> spheres) {
  const PlacedPoints points(vertices, objects, instances);
  core::Box box = points.box();
  for (const core::Sphere& sphere : spheres) {
    const double radius = std::abs(sphere.radius);
    box.include(sphere.center - Vec3d{radius, radius, radius});
    box.include(sphere.center + Vec3d{radius, radius, radius});
  }
  if (box.empty()) {
    return {{}, 1};
  }
  BoundingSphere bounds{box.center(), 0};
  double square = 0;
  points.for_each(
      [&](const Vec3d& point) {
        const Vec3d offset = point - bounds.center;
        square = std::max(square, dot(offset, offset));
      },
      [&](const core::Box& reach) {
        constexpr double rounding = 0x1p-40;
        Vec3d farthest;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          farthest[axis] =
              std::max(std::abs(reach.low[axis] - bounds.center[axis]), std::abs(reach.high[axis] - bounds.center[axis]));
        }
        return !(dot(farthest, farthest) * (1 + rounding) <= square);
      });
  bounds.radius = std::sqrt(square);
  for (const core::Sphere& sphere : spheres) {
    bounds.radius = std::max(bounds.radius, length(sphere.center - bounds.center) + std::abs(sphere.radius));
  }
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
  const std::array<Vec3d, 3> screen = core::screen_axes(view);
  const Vec3d towards_key = normalize(screen[0] * 0.7 + screen[1] + screen[2]);
  return {{bounds.center + towards_key * (distance_radii * bounds.radius), {key, key, key}, true},
          {view.from, {fill, fill, fill}, true}};
}

}  // namespace dmpc::apps
