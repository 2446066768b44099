// Mesh files, read as scenes by a process of their own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/formats/mesh_options.h"
#include "apps/formats/mesh_sky.h"
#include "apps/frontend/system/opened_files.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

struct ReaderLimits;

struct MeshFile {
  core::Scene scene;
  std::vector<std::string> notes;  ///< what of the file is not shown as it is, a sentence each
  std::vector<MeshSky> skies;      ///< whose lights add up; none unless the options say that they are shown
  StillScene still;                ///< where an animation is asked for, but for its view: at its moment
  OpenedFiles opened;              ///< with those of the textures
};

/// What ends so is read: "obj", "ply", ..., in lower case.
const std::vector<std::string>& mesh_extensions();
/// Whether the path ends as mesh files do, whatever the case of its letters, also those of formats that are refused by name.
bool is_mesh_path(const std::string& path);
/// Of these, whether it is a whole scene, with lights and a sky of its own (pbrt's): by paths that is what it is shown by.
bool has_own_sky(const std::string& path);
/// Of these, whether its animations can be played (glTF's).
bool is_played(const std::string& path);
/// "obj, ply, ...", for messages.
std::string known_mesh_formats();

/// What apps/foreign/mesh_reader.h makes of the file, in a process that opens nothing itself, may take but so much memory and
/// time, and whose crash is an error of the file's. Of what the file refers to only ordinary files beside or below it are opened,
/// unless `options` allow others. Throws core::InputError "PATH: ..." for what cannot be read or makes no scene
/// (apps/foreign/mesh/geometry.h, apps/foreign/gltf/places.h), has no triangle at all, or refers to files that cannot be had,
/// unless `options` allow that; core::CapacityError or std::bad_alloc if memory ends. `shows_progress` on stderr.
MeshFile read_mesh_file(const std::string& path, const MeshOptions& options = {}, bool shows_progress = false);
MeshFile read_mesh_file(const std::string& path, const MeshOptions& options, bool shows_progress, const ReaderLimits& limits);

}  // namespace dmpc::apps
