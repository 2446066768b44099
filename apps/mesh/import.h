// Reads a file by Assimp.
#pragma once

#include <assimp/scene.h>

#include <memory>
#include <string>
#include <vector>

#include "apps/opened_files.h"

namespace dmpc::apps {

struct ImportedFile {
  std::unique_ptr<aiScene> scene;
  OpenedFiles opened;
  std::vector<std::string> missing;  ///< files that it refers to and that could not be opened, in order, each once
};

/// What ends so is read by Assimp: "obj", "ply", ..., in lower case.
const std::vector<std::string>& mesh_extensions();

/// Reads meshes, materials, lights and cameras as the file has them. Shows its progress on stderr if `shows_progress`. Throws
/// core::InputError with Assimp's own words if it cannot read the file, std::bad_alloc if memory ends.
ImportedFile import_file(const std::string& path, bool shows_progress);

}  // namespace dmpc::apps
