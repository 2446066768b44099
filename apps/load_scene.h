// The scene that a command line names.
#pragma once

#include <string>

#include "core/scene.h"

namespace dmpc::apps {

/// `scene` is a built-in name (core/scenes.h) or else the path of an NFF file; a file that is called like a built-in scene is
/// reached as
/// ./teapot-12. Throws core::InputError with advice if it is neither or cannot be read.
core::Scene load_scene(const std::string& scene);

}  // namespace dmpc::apps
