// Vertex normals for faces that share vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "core/base/vec.h"

namespace dmpc::apps {

/// A normal for each corner, perhaps not of unit length: the sum of the area vectors of those faces around its vertex whose
/// planes lie within `degrees` (0 to 180) of its own. Vertices at one point are one. A face without area keeps its corners at 0.
/// `groups`: of each face one, where those of different groups keep their edge; faces of group 0 have no normals, and give none.
std::vector<core::Vec3d> smooth_normals(const std::vector<core::Vec3d>& vertices, const FaceList& faces, double degrees,
                                        std::span<const std::uint32_t> groups = {});

}  // namespace dmpc::apps
