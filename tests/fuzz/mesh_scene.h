// A small scene from an input's bytes: triangles, spheres and cones that often share points, touch, coincide or are all but flat.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/database/database.h"
#include "core/scene/frame.h"
#include "core/scene/scene.h"
#include "tests/fuzz/bytes.h"

namespace dmpc::tests {

/// Points, each of a kind that the input chooses; many depend on earlier ones.
class MeshPoints {
 public:
  explicit MeshPoints(Bytes& bytes) : bytes_(bytes) {}

  core::Vec3d next() {
    points_.push_back(made());
    return points_.back();
  }

 private:
  core::Vec3d made() {
    switch (bytes_.below(8)) {
      case 0:
        return earlier();
      case 1:
        return beside(earlier());
      case 2: {
        const core::Vec3d a = earlier();
        return (a + earlier()) * 0.5;
      }
      case 3:
        return bytes_.nice_point();
      case 4:
        return core::Vec3d(bytes_.odd_point());
      case 5:
        return core::Vec3d(bytes_.raw_point());
      case 6: {
        const core::Vec3d a = earlier();
        return a + bytes_.nice_point() * std::ldexp(1.0, -static_cast<int>(bytes_.below(32)));
      }
      default:
        return bytes_.lattice_point();
    }
  }

  core::Vec3d earlier() {
    const std::size_t back = bytes_.byte();
    return points_.empty() ? core::Vec3d{} : points_[points_.size() - 1 - back % points_.size()];
  }
  /// The next float along one axis, up or down.
  core::Vec3d beside(core::Vec3d point) {
    const std::size_t way = bytes_.below(6);
    const float infinite = std::numeric_limits<float>::infinity();
    double& x = point[way / 2];
    x = double{std::nextafterf(static_cast<float>(x), way % 2 == 0 ? infinite : -infinite)};
    return point;
  }

  Bytes& bytes_;
  std::vector<core::Vec3d> points_;
};

inline double mesh_radius(Bytes& bytes) {
  switch (bytes.below(4)) {
    case 0:
      return bytes.nice();
    case 1:
      return double{bytes.odd()};
    case 2:
      return double{bytes.raw()};
    default:
      return 0.25;
  }
}

/// Closed, so that a ray can leak out.
inline void add_tetrahedron(const std::array<core::Vec3d, 4>& corners, core::SceneBuilder& builder) {
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    builder.polygon({corners[(left_out + 1) % 4], corners[(left_out + 2) % 4], corners[(left_out + 3) % 4]});
  }
}

inline void add_primitive(Bytes& bytes, MeshPoints& points, core::SceneBuilder& builder) {
  const core::Vec3d a = points.next();
  switch (bytes.below(8)) {
    case 0:
      return builder.sphere(a, mesh_radius(bytes));
    case 1: {
      const double radius = mesh_radius(bytes);
      const core::Vec3d b = points.next();
      return builder.cone(a, radius, b, mesh_radius(bytes));
    }
    case 2: {
      const core::Vec3d b = points.next(), c = points.next();
      return builder.polygon({a, b, c, points.next()});
    }
    case 3: {
      const core::Vec3d b = points.next(), c = points.next();
      return add_tetrahedron({a, b, c, points.next()}, builder);
    }
    default: {
      const core::Vec3d b = points.next();
      return builder.polygon({a, b, points.next()});
    }
  }
}

/// Up to 32 objects under one light, seen from anywhere that a file may name.
inline core::Scene mesh_scene(Bytes& bytes) {
  constexpr std::size_t objects_max = 32;
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.light({.position = {3, 4, 5}});
  builder.material({.diffuse = 0.5, .specular = 0.5, .shine = 3, .transmittance = 0.5, .refraction_index = 1.5});
  MeshPoints points(bytes);
  const std::size_t count = 1 + bytes.below(objects_max);
  for (std::size_t i = 0; i < count; ++i) {
    add_primitive(bytes, points, builder);
  }
  constexpr std::array<double, 8> distances{1, 2, 4, 10, 100, 1000, 1e6, 1e29};
  scene.view.from = {distances[bytes.below(distances.size())], 0.5, 0.25};
  return scene;
}

/// Coarse grids and fine ones.
inline core::BuildOptions mesh_options(Bytes& bytes) {
  constexpr std::array<std::size_t, 4> page_sizes{512, 1024, 4096, 65536};
  constexpr std::array<double, 4> densities{1, 32, 512, 4096};
  core::BuildOptions options;
  options.page_size_bytes = page_sizes[bytes.below(page_sizes.size())];
  options.cells_per_primitive = densities[bytes.below(densities.size())];
  bytes.byte();  // which kept inputs have here
  return options;
}

}  // namespace dmpc::tests
