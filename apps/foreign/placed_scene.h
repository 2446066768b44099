// What a mesh file holds as a scene.
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh_reader.h"

namespace dmpc::apps {

/// A shape with several transforms is instanced, except shapes that are round there, emit to the front alone, or are smoothed by
/// `options`: these are copied. A file with ambient light has lights by path tracing, with its own sky, of the strength that it
/// says; else as bright as in the middle of the scene. Throws as read_mesh() does.
MeshScene placed_scene(PlacedFile file, const std::string& path, const MeshOptions& options, SceneFiles& files);

}  // namespace dmpc::apps
