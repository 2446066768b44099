#include "core/scene/expanded_size.h"

#include <limits>

#include "core/base/expect.h"

namespace dmpc::core {

void ExpandedSize::check() const {
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - std::uint64_t{1};
  if (std::max({objects, vertices, normals, corners}) > most) {
    throw RoomError("with every instance the scene has more than 4294967294 vertices, normals or objects; divide it");
  }
}

ExpandedSize size_of_pools(const Scene& scene) {
  return {scene.objects.size(), scene.vertices.size(), scene.normals.size(), scene.corners.size()};
}

}  // namespace dmpc::core
