// How much of a scene would be there once, if meshes that stand in several places were.
#pragma once

#include <cstdint>

#include "core/scene/scene.h"

namespace dmpc::core {

/// So many primitives and places has a tree room for in whose leaves places stand (levels_above_instances).
inline constexpr std::uint64_t beside_places_max = 1U << 21U;

/// In corners of polygons: 3 of a triangle.
struct KeptShare {
  std::uint64_t seen = 0;    ///< with a copy of each mesh in each of its places
  std::uint64_t stored = 0;  ///< with each mesh once; a place counts as two triangles, since its record is as long as theirs
  std::uint64_t places = 0;
  std::uint64_t own = 0;  ///< primitives of no mesh that is kept: triangles, spheres, cones

  /// Whether less than half of the scene is left to store.
  bool halves() const { return 2 * stored < seen; }
  /// Whether a tree has room for what is of no mesh and for the places, unless many faces cover others in their plane.
  bool has_room() const { return own + places <= beside_places_max; }
};

/// Of a scene with copies of kept meshes or without. A mesh that shines or is too large is not kept; what else keeps one from it
/// is not asked.
KeptShare kept_share(const Scene& scene);

}  // namespace dmpc::core
