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
  StillScene still;                ///< where an animation is asked for: the still scene at its moment, without its view
  OpenedFiles opened;              ///< with those of the textures
};

/// What ends so is read: "obj", "ply", ..., in lower case.
const std::vector<std::string>& mesh_extensions();
/// Whether the path ends as mesh files do, whatever the case of its letters, also those of formats that are refused by name.
bool is_mesh_path(const std::string& path);
/// Whether the mesh file is a whole scene with its own lights and sky (pbrt's), by which path tracing shows it.
bool has_own_sky(const std::string& path);
/// Whether the mesh file can contain animations that are played (glTF's).
bool is_played(const std::string& path);
/// "obj, ply, ...", for messages.
std::string known_mesh_formats();

/// Reads the file by apps/foreign/mesh_reader.h in a process that cannot open files itself and has limited memory and time; its
/// crash is reported as an error of the file. Only ordinary files beside or below the file are opened for it, unless `options`
/// allow others. Throws core::InputError "PATH: ..." for a file that cannot be read or makes no scene
/// (apps/foreign/mesh/geometry.h, apps/foreign/gltf/places.h), has no triangle at all, or refers to missing files, unless
/// `options` allow that; core::CapacityError or std::bad_alloc if memory is exhausted. `shows_progress` on stderr.
MeshFile read_mesh_file(const std::string& path, const MeshOptions& options = {}, bool shows_progress = false);
MeshFile read_mesh_file(const std::string& path, const MeshOptions& options, bool shows_progress, const ReaderLimits& limits);

}  // namespace dmpc::apps
