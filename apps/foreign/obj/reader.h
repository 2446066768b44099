// Reads OBJ files.
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps {

/// All faces, with materials from the files that it names. Throws core::InputError, with the line, for what it may not say,
/// core::CapacityError for more than indices reach.
PlacedFile read_obj(const std::string& path, SceneFiles& files);

}  // namespace dmpc::apps
