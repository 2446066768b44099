// A sky from a picture's file.
#pragma once

#include <string>

#include "apps/reader/confinement.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Gives the scene the picture that lies at `path`, read as apps/picture/image_file.h says, as its sky; as its background, if all
/// its texels are alike, so that nobody looks anything up. What is below 0 counts as 0. Returns what is to be said of it, nothing
/// as a rule. Throws core::InputError "--sky=PATH: ..." if there is no such picture, it is not twice as wide as high but for a
/// pixel, it has what is no number or beyond 1e30, whose place is told from the top left, or more than core::SkyTexels::size_max
/// texels along a side; ComputerCapacityError if it takes more memory than there is.
std::string read_sky(const std::string& path, Sandbox sandbox, core::Scene& scene);

/// A sentence about a sky of so much contrast that it is not shown as it is, or nothing.
std::string contrast_text(const core::SkyTexels& sky);

}  // namespace dmpc::apps
