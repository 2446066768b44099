// How large a scene is that is built without the copies it leaves out.
#pragma once

#include <cstdint>
#include <limits>

#include "core/database/database.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// For a scene that leaves copies out and whose instances are to be kept (BuildOptions::keeps_instances).
struct CopyLimits {
  /// No more corners of copies than this are put in on the way: then all is said of them that is said of others. Of more,
  /// places alone are there (core/database/left_out_places.h), and nobody looks at what rounding does to copies.
  std::uint64_t corners_max = std::uint64_t{3} << 21U;
  /// The scene with all copies may be so large where a mesh or a place cannot be kept, so that they have to be put in.
  std::uint64_t bytes_max = std::numeric_limits<std::uint64_t>::max();
};

/// build_database() within other limits. Throws RoomError, too, if copies that have to be put in have no room.
Database build_database(Scene&& scene, const BuildOptions& options, const CopyLimits& limits);

}  // namespace dmpc::core
