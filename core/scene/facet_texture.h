// Textures of roughness and metal for microfacet surfaces, as in glTF.
#pragma once

#include "core/scene/scene.h"

namespace dmpc::core {

/// Converts a scene's textures of metal and roughness, which were read as pictures, to numbers without a curve
/// (TexelFormat::linear), whose smaller levels are means of these. For FacetTexture::mean, factors are multiplied by the mean of
/// the finest level, and the texture is removed from the scene if it is not used elsewhere; the others follow those of colours.
/// Requires that no such texture is also one of a colour.
void settle_facet_textures(Scene& scene);

}  // namespace dmpc::core
