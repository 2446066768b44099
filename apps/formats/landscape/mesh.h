// The landscape's ground and lake as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/vec.h"

namespace dmpc::apps {

/// Called now and then from the calling thread with the number of rows done: first of the ground, then of its picture. May be
/// empty.
using RowsDone = std::function<void(std::uint64_t done, std::uint64_t total)>;

/// A primitive of glTF: vertices, and three indices per triangle, counter-clockwise as seen from above.
struct LandscapeMesh {
  using Point = std::array<float, 3>;
  std::vector<Point> positions, normals;
  std::vector<std::array<float, 2>> places;  ///< texture coordinates: s to the right, t downwards; or none
  std::vector<std::uint32_t> indices;
};

/// Adds a vertex without texture coordinates.
void add_vertex(LandscapeMesh& mesh, const core::Vec3d& position, const core::Vec3d& normal);

/// 4^size triangles over a lattice of 2^size by 2^(size - 1) squares, x from -1 to 1, z from -1/2 to 1/2; size from 1 to 13.
LandscapeMesh ground_mesh(int size, const RowsDone& rows_done = {});

/// Two triangles.
LandscapeMesh lake_mesh();

}  // namespace dmpc::apps
