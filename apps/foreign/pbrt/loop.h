// Loop's subdivision (C. Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987).
#pragma once

#include <cstdint>
#include <vector>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "core/base/vec.h"

namespace dmpc::apps::pbrt {

/// So many triangles may a mesh become.
inline constexpr std::uint64_t subdivided_max = std::uint64_t{1} << 24U;

/// Triangles divided in four so many times, their corners then put where they would come to lie after endlessly many times, with
/// the surface's normals there: the weights are those of J. Warren's rule for what lies within, cubic splines for edges (pbrt's).
/// Normals along edges are means of the faces'. Throws core::InputError for what is no surface: an edge of three faces, faces
/// that are not turned alike, a vertex at which two surfaces touch; and for more triangles than there may be.
PolygonMesh subdivided(std::vector<core::Vec3d> vertices, std::vector<std::uint32_t> corners, int levels);

}  // namespace dmpc::apps::pbrt
