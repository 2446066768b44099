// Closed bodies: no ray that starts inside gets out.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// About as large as a ball of radius 1 about the origin.
struct ClosedBody {
  std::string name;
  core::Scene scene;
  std::function<core::Vec3d(Random&)> inside;  ///< a random place well within it
  bool is_mesh = true;                         ///< has triangles and polygons only

  /// A random place well without it.
  static core::Vec3d outside(Random& random) { return random.direction() * random.between(2.0, 4.0); }
};

/// A cube of twelve triangles, a tetrahedron, a sphere, a sphere with noisy radii, a torus, a prism over a concave polygon, and
/// one of spheres, cones and cylinders.
std::vector<ClosedBody> closed_bodies();
/// A sphere of 9,660 triangles with slightly noisy radii.
ClosedBody fine_sphere();

/// The scene and its view scaled, then moved; vertices rounded to single precision in the end if `in_single`.
core::Scene transformed(core::Scene scene, double factor, const core::Vec3d& offset, bool in_single = false);

/// Whether each edge of each triangle has a partner that runs the other way between the very same vertices.
bool is_closed(std::span<const core::PrimitiveValues> triangles);

}  // namespace dmpc::apps
