// Whether two bodies lie in one plane, in double.
#pragma once

#include <cstdint>

#include "apps/lab/oracle/accurate/scene.h"

namespace dmpc::apps {

/// Whether both are triangles and the corners of the smaller one lie in the plane of the other, but for what float makes of
/// coordinates within the scene's bounds.
bool share_plane(const AccurateScene& scene, std::uint32_t a, std::uint32_t b);

}  // namespace dmpc::apps
