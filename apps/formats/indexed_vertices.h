// The vertices of a scene's objects, with shared ones stored once.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/vec.h"

namespace dmpc::apps {

struct IndexedVertices {
  std::vector<core::Vec3d> points;     ///< no more than there are indices
  std::vector<std::uint32_t> indices;  ///< point of each vertex, in the scene's order
};

inline std::vector<core::Vec3d> expanded(const IndexedVertices& vertices) {
  std::vector<core::Vec3d> all;
  all.reserve(vertices.indices.size());
  for (const std::uint32_t index : vertices.indices) {
    all.push_back(vertices.points[index]);
  }
  return all;
}

}  // namespace dmpc::apps
