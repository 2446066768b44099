// A scene of a file that holds all of it, with its lights and sky.
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh_reader.h"

namespace dmpc::apps {

/// A shape that stands in several places is an instance in each, but for what is round there, shines to its front alone, or is
/// smoothed by `options`: these are copied. By paths, which is below the file's own sky, point lights are spheres of a
/// thousandth of the scene that fall off as physics has it; else, and where they are far away, they are ours, as bright in the
/// middle of the scene. Throws as read_mesh() does.
MeshScene placed_scene(PlacedFile file, const std::string& path, const MeshOptions& options, SceneFiles& files);

/// What is known of files that cannot be had: an error, unless the options allow that; then notes.
void judge_missing(const std::vector<std::string>& missing, const MeshOptions& options, std::vector<std::string>& notes);
/// One line for all textures that are not where the file says.
void note_other_names(const std::vector<std::string>& names, std::vector<std::string>& notes);

}  // namespace dmpc::apps
