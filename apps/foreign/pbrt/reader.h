// Scenes of pbrt-v4 (M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition; pbrt.org, "pbrt-v4 Input File
// Format").
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"
#include "apps/formats/mesh_options.h"

namespace dmpc::apps::pbrt {

/// The scene that begins with this file, in right-handed coordinates: where pbrt's camera sees left-handed ones, x is turned
/// round. Throws core::InputError, with file, line and column, for what pbrt-v4 does not read, std::bad_alloc if memory ends.
PlacedFile read_pbrt(const std::string& path, const MeshOptions& options, SceneFiles& files);

}  // namespace dmpc::apps::pbrt
