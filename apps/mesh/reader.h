// Reads a mesh file as a scene.
#pragma once

#include <string>
#include <vector>

#include "apps/mesh/options.h"
#include "apps/opened_files.h"
#include "core/scene.h"

namespace dmpc::apps {

struct MeshFile {
  core::Scene scene;
  std::vector<std::string> notes;  ///< what of the file is not shown as it is, a sentence each
  OpenedFiles opened;              ///< with those of the textures
};

/// Whether the path ends as mesh files do, whatever the case of its letters.
bool is_mesh_path(const std::string& path);
/// "obj, ply, ...", for messages.
std::string known_mesh_formats();

/// All triangles and polygons, instances expanded; the file's first camera, else the whole scene in view; its lights, else two of
/// ours; a plain background. Throws core::InputError "PATH: ..." for what cannot be read or makes no scene (apps/mesh/geometry.h,
/// apps/mesh/placement.h), has no triangle at all, or refers to files that cannot be had, unless `options` allow that;
/// std::bad_alloc if memory ends. `shows_progress` on stderr.
MeshFile read_mesh_file(const std::string& path, const MeshOptions& options = {}, bool shows_progress = false);

}  // namespace dmpc::apps
