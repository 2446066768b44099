// Vertex normals for faces that share vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "core/base/vec.h"

namespace dmpc::apps {

/// A normal per corner, not normalized: the sum of the area vectors of the faces around its vertex whose planes are within
/// `degrees` (0 to 180) of its own. Vertices at one point count as one. Corners of a face without area have normal 0. `groups`:
/// one per face; edges between different groups stay sharp, and faces of group 0 have no normals, and contribute none.
std::vector<core::Vec3d> smooth_normals(const std::vector<core::Vec3d>& vertices, const FaceList& faces, double degrees,
                                        std::span<const std::uint32_t> groups = {});

}  // namespace dmpc::apps
