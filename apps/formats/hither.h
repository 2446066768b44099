// What NFF's hither distance would hide: rays begin at the eye and know no such plane.
#pragma once

#include <cstdint>
#include <string>

#include "core/scene/scene.h"

namespace dmpc::apps {

/// How many objects show in the scene's view, wholly or in part, nearer to the eye than its hither distance, as far as what lies
/// around a sphere or a cone tells; whether others hide them does not matter.
std::uint64_t objects_before_hither(const core::Scene& scene);

/// A sentence about them; nothing if there are none, since then the picture is what it would be without them.
std::string hither_note(const core::Scene& scene);

}  // namespace dmpc::apps
