// The scene that a command line names.
#pragma once

#include <string>
#include <vector>

#include "apps/distinct_files.h"
#include "apps/picture_options.h"
#include "core/scene.h"

namespace dmpc::apps {

/// `scene` is a built-in name (core/scenes.h) or else the path of an NFF file; a file that is called like a built-in scene is
/// reached as ./teapot-12. Throws core::InputError with advice if it is neither, cannot be read, or has a view of more than
/// `pixels_max` pixels.
core::Scene load_scene(const std::string& scene, std::int64_t pixels_max = picture_pixels_max);

/// Adds the file that load_scene(scene) reads, if it reads one.
void add_scene_file(const std::string& scene, std::vector<NamedFile>& inputs);

/// The scene of a picture; its view may be of any size if the options give another one.
core::Scene load_scene(const PictureOptions& picture);

}  // namespace dmpc::apps
