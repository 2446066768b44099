// Scenes of 1987 for a path tracer of today.
#pragma once

#include "core/scene/scene.h"

namespace dmpc::apps {

/// Point lights become balls that shine, of a radius of a twentieth of the diagonal of all objects (core::make_lights_spheres());
/// what mirrors becomes a metal as far as it does, whose tiny mirrors have a roughness of 0.3. What has tiny mirrors already
/// keeps them.
void light_and_polish(core::Scene& scene);

}  // namespace dmpc::apps
