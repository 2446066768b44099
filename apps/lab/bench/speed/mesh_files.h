// A scene's triangles as mesh files, for readers to be timed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/database/database.h"

namespace dmpc::apps {

/// Triangles that share their vertices.
struct SharedMesh {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A database's triangles, in its coordinates and its order; spheres and cones are left out.
SharedMesh mesh_of(const core::Database& database);

/// The bytes of a binary PLY file of it. Byte order and sizes of this computer, which is little-endian.
std::string ply_of(const SharedMesh& mesh);
/// The bytes of a GLB file (glTF 2.0 in one) of it. Requires a triangle.
std::string glb_of(const SharedMesh& mesh);

}  // namespace dmpc::apps
