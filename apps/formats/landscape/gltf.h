// The landscape as glTF 2.0 (Khronos Group, 2017): a JSON text that names a file of numbers and a picture.
#pragma once

#include <string>

#include "apps/formats/landscape/grove.h"
#include "apps/formats/landscape/mesh.h"

namespace dmpc::apps {

struct LandscapeGltf {
  std::string json;     ///< contents of the .gltf
  std::string numbers;  ///< contents of `numbers_name`, little-endian
};

/// Ground with the texture `picture_name`, a lake that mirrors, and a camera at the lake's near end. Both names are of files
/// beside the .gltf, with only letters, digits, dots, - and _. Trees, if there are any, are instances of a mesh for each kind, by
/// EXT_mesh_gpu_instancing (Khronos Group).
LandscapeGltf landscape_gltf(const LandscapeMesh& ground, const LandscapeMesh& lake, const std::string& numbers_name,
                             const std::string& picture_name, const Grove* trees = nullptr);

}  // namespace dmpc::apps
