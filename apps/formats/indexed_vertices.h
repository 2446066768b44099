// The vertices of a scene's objects, with shared ones stored once.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/ranges.h"
#include "core/base/vec.h"

namespace dmpc::apps {

struct IndexedVertices {
  std::vector<core::Vec3d> points;     ///< no more than there are indices
  std::vector<std::uint32_t> indices;  ///< point of each vertex, in the scene's order
};

inline std::vector<core::Vec3d> expanded(const IndexedVertices& vertices) {
  return core::mapped<core::Vec3d>(vertices.indices, [&](const std::uint32_t index) { return vertices.points[index]; });
}

}  // namespace dmpc::apps
