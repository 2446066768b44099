// Closed bodies: no ray that starts inside may leave.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// A body about as large as a ball of radius 1 about the origin.
struct ClosedBody {
  std::string name;
  core::Scene scene;
  std::function<core::Vec3d(Random&)> inside;  ///< a random point well inside it
  bool is_mesh = true;                         ///< has triangles and polygons only

  /// Returns a random point well outside it.
  static core::Vec3d outside(Random& random) { return random.direction() * random.between(2.0, 4.0); }
};

/// Returns a cube of twelve triangles, a tetrahedron, a sphere, a sphere with noisy radii, a torus, a prism over a concave
/// polygon, and a body of spheres, cones and cylinders.
std::vector<ClosedBody> closed_bodies();
/// Returns a sphere of 9,660 triangles with slightly noisy radii.
ClosedBody fine_sphere();

/// Returns the scene and its view scaled, then moved; vertices are finally rounded to single precision if `in_single`.
core::Scene transformed(core::Scene scene, double factor, const core::Vec3d& offset, bool in_single = false);

/// Returns whether each edge of each triangle has a partner in the opposite direction between the very same vertices.
bool is_closed(std::span<const core::PrimitiveValues> triangles);

}  // namespace dmpc::apps
