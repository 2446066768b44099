// Triangulation of a polygon by ear clipping.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/flat_polygon.h"

namespace dmpc::core {

struct EarClipping {
  std::vector<CornerTriangle> triangles;
  std::uint64_t nodes_visited = 0;  ///< the cost: nodes of a tree of the corners, about n log n
};

/// Repeatedly cuts off the first ear in the order of the corners (G. Meisters, "Polygons Have Ears", 1975), or, if rounding or
/// self-intersection leaves none, the corner that turns left most. A corner that is no ear remembers one that prevents it, and is
/// tested again when that one or a neighbour is removed: so a polygon takes about n log n steps. `polygon` has at least 3
/// corners.
EarClipping clip_ears(const FlatPolygon& polygon);

}  // namespace dmpc::core
