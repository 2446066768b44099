// Rays from an input's bytes, in a scene's grid: at vertices, edges and silhouettes, along axes and planes between cells, and of
// any bits.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "apps/lab/bench/stability/axes.h"
#include "apps/lab/bench/stability/rays.h"
#include "apps/lab/bench/stability/targets.h"
#include "core/database/database.h"
#include "core/record/ray.h"
#include "tests/fuzz/bytes.h"

namespace dmpc::tests {

class MeshRays {
 public:
  MeshRays(Bytes& bytes, const core::Database& database) : bytes_(bytes), database_(database) {}

  core::Ray next() {
    core::Ray ray = aimed();
    constexpr std::array<float, 8> extents_back{0, 0, 0, 1, 3, 100, 1000, 1e6F};
    ray.origin = ray.origin - ray.direction * extents_back[bytes_.below(extents_back.size())];
    ray.origin = core::coordinates_of(core::Vec3d(ray.origin));  // as all rays start
    ray.t_max = end();
    if (bytes_.byte() % 4 == 1) {
      ray.ignored_primitive = triangle();
    }
    return ray;
  }

 private:
  core::Ray aimed() {
    const core::Vec3d from = place();
    switch (bytes_.below(4)) {
      case 0:
        return apps::ray_from(core::Vec3f(from), bytes_.raw_point());
      case 1:
        return apps::ray_from(core::Vec3f(from), bytes_.odd_point());
      case 2: {
        const float zero = apps::zeros[bytes_.below(apps::zeros.size())];
        return apps::ray_from(core::Vec3f(from), apps::axis_directions(zero)[bytes_.below(26)]);
      }
      default:
        return apps::ray_through(from, place());
    }
  }

  float end() {
    switch (bytes_.below(8)) {
      case 1:
        return bytes_.raw();
      case 2:
        return bytes_.odd();
      case 3:
        return static_cast<float>(std::fabs(bytes_.nice()));
      default:
        return std::numeric_limits<float>::infinity();
    }
  }

  /// Rays start on no curved primitive that they ignore.
  std::uint32_t triangle() {
    const auto primitives = database_.primitives();
    const std::uint32_t id = bytes_.byte();
    return id < primitives.size() && primitives[id].kind == core::PrimitiveKind::triangle ? id : core::no_primitive;
  }

  /// Grid-local.
  core::Vec3d place() {
    switch (bytes_.below(5)) {
      case 0:
        return core::Vec3d(bytes_.raw_point());
      case 1:
        return bytes_.nice_point() * 0.25;
      case 2: {
        const double x = on_plane(0), y = on_plane(1);
        return {x, y, on_plane(2)};
      }
      default:
        return database_.primitives().empty() ? core::Vec3d{} : on_primitive();
    }
  }

  /// On a plane of the lattice, often one between cells or macro cells.
  double on_plane(std::size_t axis) {
    const core::GridFrame& frame = database_.header().frame;
    const int cells = frame.resolution[axis] * core::finest_per_cell;
    constexpr std::array<int, 5> spans{1, 4, 16, core::finest_per_cell, core::finest_per_macro};
    const int span = spans[bytes_.below(spans.size())];
    return core::plane_at(frame, axis, bytes_.word() % cells & -span);
  }

  core::Vec3d on_primitive() {
    const auto primitives = database_.primitives();
    const core::PrimitiveValues& primitive = primitives[bytes_.byte() % primitives.size()];
    const std::size_t index = bytes_.byte();
    if (primitive.kind == core::PrimitiveKind::triangle) {
      return apps::target_of(primitive, index % apps::targets_per_triangle);
    }
    const std::size_t end = primitive.kind == core::PrimitiveKind::cone && index % 2 == 1 ? 4 : 0;
    const core::Vec3d aside(apps::axis_directions(0)[index / 2 % 26]);
    const double radius = std::fabs(double{primitive.value[end + 3]});
    return primitive.vector(end) + aside * (radius * (index < 128 ? 1 : 0));
  }

  Bytes& bytes_;
  const core::Database& database_;
};

}  // namespace dmpc::tests
