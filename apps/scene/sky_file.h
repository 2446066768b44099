// A sky from a picture's file.
#pragma once

#include <string>

#include "apps/reader/confinement.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Gives the scene the picture that lies at `path`, read as apps/picture/image_file.h says, as its sky; as its background, if all
/// its texels are alike, so that nobody looks anything up. Returns what is to be said of it, nothing as a rule. Throws
/// core::InputError "--sky=PATH: ..." if there is no such picture, or it has a number below 0 or one that is none, whose place is
/// told from the top left, or more than core::SkyTexels::size_max texels along a side; ComputerRoomError if it takes more memory
/// than there is.
std::string read_sky(const std::string& path, Sandbox sandbox, core::Scene& scene);

}  // namespace dmpc::apps
