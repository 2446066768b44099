// Scenes by name: a built-in one or a file.
#pragma once

#include <string>

#include "core/scene.h"

namespace dmpc::apps {

/// `name` is a built-in name (core/scenes.h) or else the path of an NFF file; a file that is named like a family needs a folder
/// before it (./teapot). Throws core::InputError.
core::Scene open_scene(const std::string& name);

/// Writes the built-in scene `name` as NFF: to the file `path`, whole or not at all, or to standard output if `path` is empty.
/// Throws core::InputError if there is no such scene or it cannot be written.
void write_built_in_scene(const std::string& name, const std::string& path);

}  // namespace dmpc::apps
