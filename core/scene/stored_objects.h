// What is known of the objects and texels of a scene of which only the database is there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "core/base/box.h"
#include "core/scene/base_meshes.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// Of one size.
struct StoredCounts {
  std::array<std::uint64_t, object_kind_count> objects{};  ///< by ObjectKind, with all copies
  Box bounds;                                              ///< of everything finite, in the world
  double eye_distance = 0;                                 ///< eye_distance() of the view for which the database was built
  InstancingShare share;
  std::uint64_t meshes = 0, mesh_triangles = 0, triangles_in_places = 0;  ///< those with several instances

  std::uint64_t object_count() const {
    std::uint64_t count = 0;
    for (const std::uint64_t of_kind : objects) {
      count += of_kind;
    }
    return count;
  }
};

struct StoredObjects : StoredCounts {
  std::map<std::string, std::string> identity;  ///< texts about them by which pictures are told apart (apps/render)
};

}  // namespace dmpc::core
