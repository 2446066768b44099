// Reads OBJ files.
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps {

/// Reads all faces, and the materials from the libraries that the file names. Throws core::InputError, with the line, for
/// invalid input, and core::CapacityError if indices do not suffice.
PlacedFile read_obj(const std::string& path, SceneFiles& files);

}  // namespace dmpc::apps
