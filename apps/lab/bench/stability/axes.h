// Rays along axes and diagonals in a scene of boxes, from points that are most likely to confuse a traversal.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/lab/bench/stability/mesh.h"
#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/scene/frame.h"

namespace dmpc::apps {

/// Substitutes for 0 in a direction: both zeros, a denormal number, a number whose reciprocal overflows with the grid's extent.
inline constexpr std::array<float, 8> zeros{0.0F, -0.0F, 1e-40F, -1e-40F, 1e-30F, -1e-30F, 9e-19F, -9e-19F};

/// Returns a direction along -1, 0 and 1, with `zero` for 0: of unit length up to rounding, with unchanged zeros.
inline core::Vec3f axis_direction(const std::array<float, 3>& components) {
  const double size = std::sqrt(double{components[0]} * double{components[0]} + double{components[1]} * double{components[1]} +
                                double{components[2]} * double{components[2]});
  core::Vec3f direction;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float x = components[axis];
    direction[axis] = std::fabs(x) < 1.0F ? x : static_cast<float>(double{x} / size);
  }
  return direction;
}

/// Returns the 26 directions with components along -1, 0 and 1.
inline std::vector<core::Vec3f> axis_directions(float zero) {
  std::vector<core::Vec3f> all;
  const std::array<float, 3> values{-1.0F, zero, 1.0F};
  for (std::size_t i = 0; i < 27; ++i) {
    if (i != 13) {
      all.push_back(axis_direction({values[i % 3], values[i / 3 % 3], values[i / 9]}));
    }
  }
  return all;
}

/// Returns boxes with faces along the axes, two meshes without such faces, and sheets that intersect everything.
inline core::Scene crowded_scene() {
  core::Scene scene;
  add(scene, moved(sphere_mesh(8, 12, 0.2), 0.5, {0.3, 0.3, 0}));
  add(scene, cube());
  add(scene, moved(cube(), 0.25, {-0.5, -0.5, 0.5}));
  add(scene, moved(tetrahedron(), 0.25, {0.5, -0.5, -0.5}));
  core::SceneBuilder builder(scene);
  for (const double z : {-0.5, 0.0, 0.25}) {
    builder.polygon({{-0.9, -0.9, z}, {0.9, -0.9, z}, {0.9, 0.9, z}, {-0.9, 0.9, z}});
  }
  return scene;
}

/// Gives the number of cells that cuts crowded_scene() into 2x2x2 macro cells.
inline const core::BuildOptions crowded_options{.cells_per_primitive = 4};

/// Returns a coordinate on a plane of the lattice, often one between cells or macro cells, on the bound or on a face of
/// crowded_scene(), or anywhere.
inline double awkward(const core::Database& database, std::size_t axis, Random& random) {
  const core::GridFrame& frame = database.header().frame;
  const int cells = frame.resolution[axis] * core::finest_per_cell;
  switch (random.below(4)) {
    case 0: {
      constexpr std::array<std::size_t, 5> spans{1, 4, 16, core::finest_per_cell, core::finest_per_macro};
      const std::size_t plane = random.below(static_cast<std::size_t>(cells)), span = spans[random.below(spans.size())];
      return core::plane_at(frame, axis, static_cast<std::int32_t>(plane - plane % span));
    }
    case 1:
      return to_local(frame, random.bits() % 2 == 0 ? core::Vec3d{-1, -1, -1} : core::Vec3d{1, 1, 1})[axis];
    case 2:
      return to_local(frame, core::Vec3d{0.25, 0.25, 0.25})[axis];
    default:
      return random.between(core::plane_at(frame, axis, 0), core::plane_at(frame, axis, cells));
  }
}

inline core::Vec3f awkward_point(const core::Database& database, Random& random) {
  const double x = awkward(database, 0, random), y = awkward(database, 1, random);
  return core::Vec3f(core::Vec3d{x, y, awkward(database, 2, random)});
}

}  // namespace dmpc::apps
