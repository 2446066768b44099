// Loads the scene that a command line names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/frontend/system/distinct_files.h"
#include "apps/frontend/system/opened_files.h"
#include "apps/scene/picture_options.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// `scene` is a built-in name (core/families/scenes.h) or else the path of a file: a mesh file by its extension, else an NFF
/// file, with extension .nff or none. A file with the name of a built-in scene needs a path such as ./teapot-12. Throws
/// core::InputError with advice if it is none of these, cannot be read, or has a view of more than `pixels_max` pixels. Features
/// of a mesh file that are not shown exactly are reported on stderr, once per process.
core::Scene load_scene(const std::string& scene, std::int64_t pixels_max = picture_pixels_max);

/// Whether load_scene(scene) reads it as a mesh file.
bool is_mesh(const std::string& scene);

/// Whether it is a whole scene with its own sky (apps/formats/mesh_file.h).
bool is_below_own_sky(const std::string& scene);
/// The scene's own sky as a choice: the scene's path.
SkyChoice own_sky(const std::string& scene);
bool is_own_sky(const PictureOptions& picture);

/// Adds the file that load_scene(scene) reads, if it reads one.
void add_scene_file(const std::string& scene, std::vector<NamedFile>& inputs);

/// Whether notes of loading go to stderr.
enum class LoadNotes : std::uint8_t { said, silent };

/// The scene of a picture, with view and lights of the options; its own view may be of any size if the options give another one.
/// Throws core::UsageError, too, for options of mesh files with another scene, and if the camera does not fit the scene.
/// `opened`, if given, gets all files that were read, `still`, if an animation is asked for, the view and lights common to its
/// frames.
core::Scene load_scene(const PictureOptions& picture, LoadNotes notes = LoadNotes::said, OpenedFiles* opened = nullptr,
                       StillScene* still = nullptr);

/// Loads the scene, and prints the notes; throws core::UsageError, too, if an output is a file that the scene is read from.
core::Scene load_scene_beside(const PictureOptions& picture, const std::vector<NamedFile>& outputs);

}  // namespace dmpc::apps
