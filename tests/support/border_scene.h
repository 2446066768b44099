// A scene made for its own grid: triangles exactly in planes between cells, and rays exactly in them and along their edges.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/database/database.h"
#include "core/scene/frame.h"
#include "core/scene/scene.h"

namespace dmpc::tests {

/// Cuts a cube into 2x2x2 macro cells. Plane i of an axis lies at i * finest_cell, which single precision holds where i is half
/// an edge of a macro cell or a whole one: borders of cells and macro cells, and of regions of equal size.
class BorderScene {
 public:
  BorderScene() {
    build({.finest_cell = 0});  // all planes in the middle: the bounds and the number of primitives, hence the grid, are the same
    build(core::build_database(scene_, options()).header().frame);
  }

  const core::Scene& scene() const { return scene_; }
  static core::BuildOptions options() { return {.cells_per_primitive = 448}; }
  /// In finest cells, along each axis.
  static constexpr std::int32_t size = 2 * core::finest_per_macro;
  /// The planes with triangles; the camera sits where the first of x meets the first of z, and looks along y.
  static constexpr std::int32_t planes[] = {core::finest_per_macro / 2, core::finest_per_macro};

 private:
  void build(const core::GridFrame& frame) {
    const auto at = [&](std::size_t axis, std::int32_t plane) {
      return frame.origin[axis] + plane * double{frame.finest_cell} / frame.scale;
    };
    scene_ = {};
    scene_.name = "borders";
    scene_.background = {0.2, 0.3, 0.4};
    scene_.view = {.from = {at(0, planes[0]), -3, at(2, planes[0])},
                   .at = {at(0, planes[0]), 0, at(2, planes[0])},
                   .up = {0, 0, 1},
                   .angle_degrees = 60};
    scene_.lights = {{scene_.view.from}, {{at(0, planes[1]), -2, at(2, planes[1])}}, {{at(0, planes[0]), 0.1, 3}}};
    core::SceneBuilder builder(scene_);
    builder.material({.color = {0.8, 0.7, 0.5}, .diffuse = 0.5, .specular = 0.4, .shine = 20, .transmittance = 0.5});
    builder.polygon({{-1, -1, -1}, {-0.9, -1, -1}, {-1, -0.9, -1}, {-1, -1, -0.9}});  // two corners give the bounds
    builder.polygon({{1, 1, 1}, {0.9, 1, 1}, {1, 0.9, 1}, {1, 1, 0.9}});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::int32_t plane : planes) {
        add_square(builder, axis, at(axis, plane), {at(0, planes[0]), at(1, planes[0]), at(2, planes[0])});
      }
    }
  }

  /// Perpendicular to `axis`, with a corner on a point where planes meet.
  static void add_square(core::SceneBuilder& builder, std::size_t axis, double plane, const core::Vec3d& corner) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto point = [&](double along_u, double along_v) {
      core::Vec3d p;
      p[axis] = plane;
      p[u] = along_u;
      p[v] = along_v;
      return p;
    };
    builder.polygon({point(corner[u], corner[v]), point(0.9, corner[v]), point(0.9, 0.8), point(corner[u], 0.8)});
  }

  core::Scene scene_;
};

}  // namespace dmpc::tests
