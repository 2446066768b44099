// The faces of an OBJ file as a mesh.
#pragma once

#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/obj/geometry.h"
#include "apps/foreign/obj/materials.h"

namespace dmpc::apps::obj {

/// Requires a face. In the file's order, since of faces in one plane the first shows, with places on their materials' textures.
/// Faces of one smoothing group that have no normals of their own are smooth among themselves, whatever the angle
/// (apps/foreign/mesh/smooth.h).
PolygonMesh mesh_of(Geometry geometry, const Materials& materials);

}  // namespace dmpc::apps::obj
