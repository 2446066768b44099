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
  /// With all copies that are put in the scene may be so large while it becomes primitives.
  std::uint64_t bytes_max = std::numeric_limits<std::uint64_t>::max();
  /// Why somebody wants all of them, where that is so, and what to do if they have no room.
  const char *reason = "", *advice = "";
};

/// build_database() within other limits. Of more copies than these allow those are put in that have to be there, since something
/// keeps their mesh or place from being kept (core/database/obstacle.h). Throws RoomError, too, if copies that are put in have no
/// room.
Database build_database(Scene&& scene, const BuildOptions& options, const CopyLimits& limits);

}  // namespace dmpc::core
