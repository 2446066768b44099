// Which triangles meet in space, or all but meet, however they lean on each other.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "core/database/faces/face.h"

namespace dmpc::core {

/// Hands all pairs to `judge` whose boxes, grown by what near faces are apart, meet, which are of different objects, one of them
/// lower than `low_altitude`, and lean towards each other by no more than a quarter: buckets of planes do not tell of all of
/// those. Sorts and sweeps along one axis. False if there are too many, of which some were handed over.
bool find_meeting_faces(std::span<const Face> faces, const std::function<void(std::uint32_t, std::uint32_t)>& judge);

}  // namespace dmpc::core
