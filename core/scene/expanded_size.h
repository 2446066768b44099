// What the pools of a scene hold with all instances of it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/scene/scene.h"

namespace dmpc::core {

/// Of objects in copies; as much as 2^48 stands for more, too.
struct ExpandedSize {
  std::uint64_t objects = 0, vertices = 0, normals = 0, corners = 0;

  std::uint64_t bytes() const {
    return sizeof(Object) * objects + sizeof(Vec3d) * (vertices + normals) + sizeof(TexturedCorner) * corners;
  }
  /// Throws RoomError if that is more than indices of 32 bits reach.
  void check() const;
};

constexpr ExpandedSize operator+(const ExpandedSize& a, const ExpandedSize& b) {
  const auto sum = [](std::uint64_t x, std::uint64_t y) { return std::min(x + y, std::uint64_t{1} << 48U); };
  return {sum(a.objects, b.objects), sum(a.vertices, b.vertices), sum(a.normals, b.normals), sum(a.corners, b.corners)};
}

/// Of a scene's own objects.
ExpandedSize size_of_pools(const Scene& scene);

}  // namespace dmpc::core
