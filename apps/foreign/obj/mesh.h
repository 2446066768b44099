// Converts the faces of an OBJ file into a mesh.
#pragma once

#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/obj/geometry.h"
#include "apps/foreign/obj/materials.h"

namespace dmpc::apps::obj {

/// Requires at least one face. Faces keep the file's order, because the first of several coplanar faces is visible. Texture
/// coordinates are mapped to the textures of their materials. Faces of one smoothing group without normals of their own are
/// smooth among themselves, whatever the angle (apps/foreign/mesh/smooth.h).
PolygonMesh mesh_of(Geometry geometry, const Materials& materials);

}  // namespace dmpc::apps::obj
