// Whether two bodies lie in one plane, by what the file's doubles say.
#pragma once

#include <cstdint>

#include "apps/lab/oracle/accurate/scene.h"

namespace dmpc::apps {

/// Whether both are triangles of one plane: the corners of the smaller one lie in the plane of the other, but for what rounding
/// to double moves coordinates by (2^-51 of each, as turning a scene rounds some times). What lies farther off is apart.
bool share_plane(const AccurateScene& scene, std::uint32_t a, std::uint32_t b);

}  // namespace dmpc::apps
