// Reads a sky from an image file.
#pragma once

#include <string>

#include "apps/reader/confinement.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Sets the picture at `path`, read as apps/picture/image_file.h says, as the scene's sky; if all texels are alike, as its
/// background, which needs no look-up. Negative values count as 0. Returns a note, usually empty. Throws core::InputError
/// "--sky=PATH: ..." if there is no such picture, it is not twice as wide as high within a pixel, a texel (reported from the top
/// left) is NaN or beyond 1e30, or a side has more than core::SkyTexels::size_max texels; ComputerCapacityError if it takes more
/// memory than there is.
std::string read_sky(const std::string& path, Sandbox sandbox, core::Scene& scene);

/// A note about a sky whose contrast is too large to be shown as it is, or nothing.
std::string contrast_text(const core::SkyTexels& sky);

}  // namespace dmpc::apps
