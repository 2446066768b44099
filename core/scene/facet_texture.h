// Textures that say how rough a surface of tiny mirrors is and how much of it is metal, as glTF has them.
#pragma once

#include "core/scene/scene.h"

namespace dmpc::core {

/// Makes a scene's textures of metal and roughness, which were read as if they were pictures, what they are: numbers without a
/// curve (TexelFormat::linear), whose smaller levels are means of those. Where the mean is meant, factors are multiplied by that
/// of the finest level, and the texture is left out of the scene if nothing else has it; the others stand behind those of
/// colours. Requires that no such texture is one of a colour, too.
void settle_facet_textures(Scene& scene);

}  // namespace dmpc::core
