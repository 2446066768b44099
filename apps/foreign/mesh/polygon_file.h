// What a reader of our own has of a file that holds polygons and materials alone: no nodes, cameras or lights.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/mesh/textures.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// A material as one of ours, but for its texture, which is still to be read.
struct FileMaterial {
  core::Material material;
  std::optional<TextureUse> texture;  ///< that `material`'s colour is multiplied by
};

struct PolygonFile {
  std::vector<FileMaterial> materials;  ///< at least one if there is a mesh
  std::vector<PolygonMesh> meshes;
  std::vector<std::string> notes;    ///< what of the file is not shown as it is, a sentence each
  std::vector<std::string> missing;  ///< sentences: which files it refers to cannot be had, in order, each once
  double coordinate_rounding = 0;    ///< as core::Scene's
};

}  // namespace dmpc::apps
