// Reads a file by Assimp, or glTF 2 by a reader of our own.
#pragma once

#include <assimp/scene.h>

#include <memory>
#include <string>
#include <vector>

#include "apps/mesh/texture_place.h"
#include "apps/opened_files.h"

namespace dmpc::apps {

struct ImportedFile {
  std::unique_ptr<aiScene> scene;
  OpenedFiles opened;
  std::vector<TexturePlace> texture_places;  ///< of each material's colour texture; none where all are plain
  std::vector<std::string> notes;            ///< what of the file is not shown as it is, a sentence each
  std::vector<std::string> missing;          ///< files that it refers to and that could not be opened, in order, each once
};

/// What ends so is read: "obj", "ply", ..., in lower case.
const std::vector<std::string>& mesh_extensions();

/// Reads meshes, materials, lights and cameras as the file has them. Shows its progress on stderr if `shows_progress`. Throws
/// core::InputError with Assimp's own words if it cannot read the file, or if there is no mesh in it, std::bad_alloc if memory
/// ends.
ImportedFile import_file(const std::string& path, bool shows_progress);

}  // namespace dmpc::apps
