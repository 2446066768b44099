// The faces of an OBJ file as meshes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/mesh/texture_place.h"
#include "apps/foreign/obj/geometry.h"

namespace dmpc::apps::obj {

/// What the faces of a run need to know of their material.
struct MaterialUse {
  std::string name;                     ///< for messages
  std::optional<TexturePlace> texture;  ///< where their places lie on it, if it has one
};

/// In the file's order, since of faces in one plane the first shows: a mesh for all that follow one another and have one
/// material, and a place on its texture or none. `run_materials`: of each run, an index into `uses`.
std::vector<PolygonMesh> meshes_of(Geometry geometry, const std::vector<std::uint32_t>& run_materials,
                                   const std::vector<MaterialUse>& uses);

}  // namespace dmpc::apps::obj
