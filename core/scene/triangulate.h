// Triangulation of planar polygons, including concave ones.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vec.h"

namespace dmpc::core {

/// Corner indices of the triangles of a simple polygon, with the polygon's winding; `vertices` has at least 3. Adds no vertices,
/// so neighbours that share an edge stay closed. Convex polygons become a fan, others are triangulated by ear clipping
/// (core/scene/ear_clipper.h). A polygon without area gives nothing; a self-intersecting one gives some triangles, as quickly.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3d> vertices);

/// Whether triangulate() gives any triangle.
bool has_area(std::span<const Vec3d> vertices);

}  // namespace dmpc::core
