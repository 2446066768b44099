// Points of a primitive that rays easily miss, as targets.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/database/database.h"
#include "core/record/curved_values.h"

namespace dmpc::apps {

/// Three vertices, five points of every edge and the middle.
inline constexpr std::size_t targets_per_triangle = 19;
inline constexpr std::size_t vertices_per_triangle = 3;
inline constexpr std::size_t middle_of_triangle = targets_per_triangle - 1;

/// Returns the point of the edge from vertex `edge` on at `share` of its length, grid-local.
inline core::Vec3d on_edge(const core::PrimitiveValues& triangle, std::size_t edge, double share) {
  const core::Vec3d from = triangle.vector(3 * edge), to = triangle.vector(3 * ((edge + 1) % 3));
  return from + (to - from) * share;
}

/// Returns target `index`, below targets_per_triangle: vertices first, then the edges, then the middle.
inline core::Vec3d target_of(const core::PrimitiveValues& triangle, std::size_t index) {
  constexpr std::array<double, 5> shares{0.125, 0.3, 0.5, 0.7, 0.9375};
  if (index < vertices_per_triangle) {
    return triangle.vector(3 * index);
  }
  if (index == middle_of_triangle) {
    return (triangle.vector(0) + triangle.vector(3) + triangle.vector(6)) * (1.0 / 3.0);
  }
  const std::size_t on_edges = index - vertices_per_triangle;
  return on_edge(triangle, on_edges / shares.size(), shares[on_edges % shares.size()]);
}

/// Returns a point of the primitive's surface, grid-local, off by less than 1e-15: often on an edge or at an end.
inline core::Vec3d surface_point(const core::PrimitiveValues& primitive, Random& random) {
  switch (primitive.kind) {
    case core::PrimitiveKind::triangle: {
      const double share = random.below(4) == 0 ? 0.0 : random.unit(),
                   other = random.below(4) == 0 ? 0.0 : random.unit() * (1 - share);
      const core::Vec3d a = primitive.vector(0);
      return a + (primitive.vector(3) - a) * share + (primitive.vector(6) - a) * other;
    }
    case core::PrimitiveKind::sphere:
      return primitive.vector(0) + random.direction() * std::fabs(double{primitive.value[3]});
    case core::PrimitiveKind::cone:
    case core::PrimitiveKind::instance:  // is no primitive
      break;
  }
  const core::ConeFloats cone({primitive.value.data(), 1, 0});
  const core::Vec3d &base = cone.base, &axis = cone.axis;
  const core::Vec3d radial = normalize(cross(axis, random.direction()));
  const double height = random.below(8) == 0 ? 1.0 : random.unit();
  return base + axis * height + radial * cone.radius_at(height);
}

}  // namespace dmpc::apps
