// What a mesh file holds as a scene.
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh_reader.h"

namespace dmpc::apps {

/// A shape that stands in several places is an instance in each, but for what is round there, shines to its front alone, or is
/// smoothed by `options`: these are copied. Lights of a file that is lit whole are by paths, which is below its own sky, as
/// strong as it says; else as bright as in the middle of the scene. Throws as read_mesh() does.
MeshScene placed_scene(PlacedFile file, const std::string& path, const MeshOptions& options, SceneFiles& files);

}  // namespace dmpc::apps
