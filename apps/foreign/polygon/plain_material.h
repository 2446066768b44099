// The surface of what says no more of itself than its colour.
#pragma once

#include "core/scene/scene.h"

namespace dmpc::apps {

/// As material_of() makes it of a material that has this colour, linear and 0 to 1, and nothing else.
core::Material plain_material(const core::Vec3d& color);
/// Of what says nothing at all.
core::Material plain_material();

}  // namespace dmpc::apps
