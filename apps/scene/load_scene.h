// Loads the scene named on a command line.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/frontend/system/distinct_files.h"
#include "apps/frontend/system/opened_files.h"
#include "apps/scene/picture_options.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// `scene` is a built-in name (core/families/scenes.h) or a file path: a mesh file by its extension, else an NFF file, with
/// extension .nff or none. A file with the name of a built-in scene needs a path such as ./teapot-12. Throws core::InputError
/// with advice if it is none of these, cannot be read, or has a view of more than `pixels_max` pixels. Features of a mesh file
/// that are not shown exactly are reported on stderr, once per process.
core::Scene load_scene(const std::string& scene, std::int64_t pixels_max = picture_pixels_max);

/// Returns whether load_scene(scene) reads it as a mesh file.
bool is_mesh(const std::string& scene);

/// Returns whether it is a complete scene with its own sky (apps/formats/mesh_file.h).
bool is_below_own_sky(const std::string& scene);
/// Returns the scene's own sky as a choice: the scene's path.
SkyChoice own_sky(const std::string& scene);
bool is_own_sky(const PictureOptions& picture);

/// Adds the file that load_scene(scene) reads, if it reads one.
void add_scene_file(const std::string& scene, std::vector<NamedFile>& inputs);
void add_scene_file(const PictureOptions& picture, std::vector<NamedFile>& inputs);

/// Whether notes of loading are printed to stderr.
enum class LoadNotes : std::uint8_t { said, silent };

/// Loads the scene of a picture, with the view and lights of the options; the scene's own view may have any size if the options
/// set another one. Also throws core::UsageError for options of mesh files with another scene, and if the camera is invalid for
/// the scene. If given, `opened` receives all files that were read, and `still`, for an animation, the view and lights common to
/// its frames.
core::Scene load_scene(const PictureOptions& picture, LoadNotes notes = LoadNotes::said, OpenedFiles* opened = nullptr,
                       StillScene* still = nullptr);

/// Loads the scene and prints the notes. Also throws core::UsageError if an output is one of the scene's files.
core::Scene load_scene_beside(const PictureOptions& picture, const std::vector<NamedFile>& outputs);

}  // namespace dmpc::apps
