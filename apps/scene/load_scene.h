// The scene that a command line names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/frontend/system/distinct_files.h"
#include "apps/frontend/system/opened_files.h"
#include "apps/scene/picture_options.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// `scene` is a built-in name (core/families/scenes.h) or else the path of a file: of a mesh file by its ending, else of an NFF
/// file, which ends in .nff or has no ending. A file that is called like a built-in scene is reached as ./teapot-12. Throws
/// core::InputError with advice if it is none of these, cannot be read, or has a view of more than `pixels_max` pixels. What of a
/// mesh file is not shown as it is is said on stderr, once in a process.
core::Scene load_scene(const std::string& scene, std::int64_t pixels_max = picture_pixels_max);

/// Whether load_scene(scene) reads it as a mesh file.
bool is_mesh(const std::string& scene);

/// Whether it is a whole scene that says its own sky (apps/formats/mesh_file.h).
bool is_below_own_sky(const std::string& scene);
/// What stands for it among skies: the scene's own path.
SkyChoice own_sky(const std::string& scene);
bool is_own_sky(const PictureOptions& picture);

/// Adds the file that load_scene(scene) reads, if it reads one.
void add_scene_file(const std::string& scene, std::vector<NamedFile>& inputs);

/// Whether notes of loading go to stderr.
enum class LoadNotes : std::uint8_t { said, silent };

/// The scene of a picture, seen and lit as its options say; its view may be of any size if the options give another one. Throws
/// core::UsageError, too, for options of mesh files with another scene, and if the camera does not go with the scene. `opened`,
/// if given, gets all files that were read, `still`, if an animation is asked for, what holds for its frames.
core::Scene load_scene(const PictureOptions& picture, LoadNotes notes = LoadNotes::said, OpenedFiles* opened = nullptr,
                       StillScene* still = nullptr);

/// Loads the scene, and says the notes; throws core::UsageError, too, if one of the outputs is a file that the scene is read
/// from.
core::Scene load_scene_beside(const PictureOptions& picture, const std::vector<NamedFile>& outputs);

}  // namespace dmpc::apps
