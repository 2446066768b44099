// Reads a sky from an image file.
#pragma once

#include <string>

#include "apps/reader/confinement.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Makes the picture at `path` (apps/picture/image_file.h) the scene's sky or, if all texels are equal, its background, which
/// needs no look-up. Negative values count as 0. Returns a note, usually empty. Throws core::InputError "--sky=PATH: ..." for an
/// unreadable picture, one that is not twice as wide as high within a pixel, a texel (reported from the top left) that is NaN or
/// beyond 1e30, or a side of more than core::SkyTexels::size_max texels; ComputerCapacityError for too little memory.
std::string read_sky(const std::string& path, Sandbox sandbox, core::Scene& scene);

/// A note about a sky whose contrast is too large to be shown as it is, or nothing.
std::string contrast_text(const core::SkyTexels& sky);

}  // namespace dmpc::apps
