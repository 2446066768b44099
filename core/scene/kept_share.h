// How much of a scene would be there once, if meshes that stand in several places were.
#pragma once

#include <cstdint>

#include "core/scene/scene.h"

namespace dmpc::core {

/// In corners of polygons: 3 of a triangle.
struct KeptShare {
  std::uint64_t seen = 0;    ///< with a copy of each mesh in each of its places
  std::uint64_t stored = 0;  ///< with each mesh once; a place counts as two triangles, since its record is as long as theirs
  std::uint64_t places = 0;

  /// Whether less than half of the scene is left to store.
  bool halves() const { return 2 * stored < seen; }
};

/// Of a scene with copies of kept meshes or without.
KeptShare kept_share(const Scene& scene);

}  // namespace dmpc::core
