// Triangles that meet in space, or almost meet, at any angle.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "core/database/faces/face.h"

namespace dmpc::core {

/// Calls `judge` for all pairs of different objects whose boxes, grown by the distance of near faces, overlap, one of them lower
/// than `low_altitude`, that lean towards each other by at most a quarter: buckets of planes do not find all of these. Sorts and
/// sweeps along one axis. False if there are too many; then `judge` was called for some.
bool find_meeting_faces(std::span<const Face> faces, const std::function<void(std::uint32_t, std::uint32_t)>& judge);

}  // namespace dmpc::core
