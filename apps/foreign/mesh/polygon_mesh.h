// A mesh of polygons, by whatever reader.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/vec.h"

namespace dmpc::apps {

/// Polygons over a list of vertices, one after the other.
struct FaceList {
  std::vector<std::uint32_t> corners;  ///< indices of vertices
  std::vector<std::uint32_t> ends;     ///< of each face: one past its last corner
};

struct PolygonMesh {
  std::string name;                          ///< "mesh 3 'wheel'", for messages
  std::size_t material = 0;                  ///< index into a file's materials
  std::vector<core::Vec3d> vertices;         ///< in the world
  FaceList faces;                            ///< each of at least 3 corners
  std::vector<core::Vec3d> normals;          ///< a corner each, of any length, or none; where all of a face are 0 it is flat
  std::vector<std::array<float, 2>> places;  ///< on the texture, t downwards: a corner each, or none
  std::vector<core::Vec3d> colors;           ///< linear, 0 to 1, by which the material's is multiplied: a corner each, or none
  std::vector<double> alphas;                ///< of `colors`, 0 to 1: a corner each, or none where all are 1
};

}  // namespace dmpc::apps
