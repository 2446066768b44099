// Loop's subdivision (C. Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987).
#pragma once

#include <cstdint>
#include <vector>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "core/base/vec.h"

namespace dmpc::apps::pbrt {

/// The maximum number of triangles of a subdivided mesh.
inline constexpr std::uint64_t subdivided_max = std::uint64_t{1} << 24U;

/// Applies `levels` steps of Loop subdivision and projects vertices and normals to the limit surface: J. Warren's weights
/// inside, cubic splines on boundary edges (as in pbrt). Normals on boundary edges are means of the faces' normals. Throws
/// core::InputError for a mesh that is not a manifold surface (an edge with three faces, faces of inconsistent orientation, a
/// vertex at which two surfaces touch), and for more triangles than allowed.
PolygonMesh subdivided(std::vector<core::Vec3d> vertices, std::vector<std::uint32_t> corners, int levels);

}  // namespace dmpc::apps::pbrt
