// How much of a surface that alpha cuts out is there, seen from near and from far.
#pragma once

#include "core/scene/texture.h"

namespace dmpc::core {

/// Where alpha cuts out what is less than `cutoff`, up to 1, means of holes and leaves would be all holes, or none, from some
/// distance on. So the alpha of each level but the finest is scaled until as large a share of its texels comes up to the cutoff,
/// as nearly as they can tell; a level of which it does is left as it is (I. Castano, "Computing Alpha Mipmaps", 2010, who
/// finds the scale by bisection; here by counting). Nothing changes for a cutoff of 0, or a format without alpha.
void keep_coverage(Texture& texture, double cutoff);

}  // namespace dmpc::core
