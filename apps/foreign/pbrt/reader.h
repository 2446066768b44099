// Scenes of pbrt-v4 (M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition; pbrt.org, "pbrt-v4 Input File
// Format").
#pragma once

#include <optional>
#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"
#include "apps/formats/resolution.h"
#include "core/scene/instances.h"

namespace dmpc::apps::pbrt {

/// Whether a file's name ends in .pbrt, or .pbrt.gz, in letters of any case.
bool is_pbrt_path(const std::string& path);

/// The scene that begins with this file, in right-handed coordinates: where pbrt's camera sees left-handed ones, x is turned
/// round. Its view spans a picture of `size`, the film's if none is given. Throws core::InputError, with file, line and column,
/// for what pbrt-v4 does not read, std::bad_alloc if memory ends. `copies`: what will become of an object's instances.
PlacedFile read_pbrt(const std::string& path, const std::optional<Resolution>& size, SceneFiles& files,
                     core::Copies copies = core::Copies::put);

}  // namespace dmpc::apps::pbrt
