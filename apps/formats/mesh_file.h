// Reads mesh files as scenes in a separate process.
#pragma once

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
  std::vector<std::string> notes;  ///< features of the file that are not shown exactly, a sentence each
  std::vector<MeshSky> skies;      ///< their lights add up; empty unless the options show them
  StillScene still;                ///< where an animation is asked for: the still scene at its moment, without its view
  OpenedFiles opened;              ///< including the textures' files
};

/// Extensions of supported files: "obj", "ply", ..., in lower case.
const std::vector<std::string>& mesh_extensions();
/// Whether the path has a mesh file's extension, in any case, including formats that are refused by name.
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
