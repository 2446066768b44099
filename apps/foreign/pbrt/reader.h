// Scenes of pbrt-v4 (M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition; pbrt.org, "pbrt-v4 Input File
// Format").
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"
#include "apps/formats/mesh_options.h"

namespace dmpc::apps::pbrt {

/// Reads a scene from its first file, in right-handed coordinates: if pbrt's camera sees left-handed ones, x is negated. Throws
/// core::InputError, with file, line and column, for input that pbrt-v4 rejects; std::bad_alloc if memory is exhausted.
PlacedFile read_pbrt(const std::string& path, const MeshOptions& options, SceneFiles& files);

}  // namespace dmpc::apps::pbrt
