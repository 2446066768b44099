// Triangles that cover each other in one plane: a rug in the floor's plane, a box that stands on it, a face that is there twice.
#pragma once

#include "core/database/conversion.h"
#include "core/database/grid/macro_cells.h"
#include "core/database/parallel.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// Rounding would let now the one and now the other of them be nearer. So triangles that cover each other and lie in one plane,
/// except for what rounding their corners to float moves them by, share a FacePlane, by which a ray meets all of them at the same t,
/// and the least id wins. Ids follow the file's order: the earlier shows. But what shines gets an earlier id than what it lies
/// on, and what lets light through a later one (Material::rank_in_plane()), whose place in the file it takes. Of triangles with
/// the same three corners only the first by that is kept. What shines and shows whole is noted (Conversion::whole_lamps).
///
/// What the file's doubles tell apart stays apart, a poster before a wall, the two sides of a pane: where faces that cover each
/// other are not in one plane for doubles, except for floats, or nearer than rays start off a triangle, they and all triangles of
/// their polygons get the planes that doubles say (core/database/faces/face_stack.h); those in each are settled by themselves, as
/// above. So do faces so far off these as their layers move a t, and those off these.
///
/// What shares an edge or a corner does not cover. Without triangles that cover each other nothing changes. Not judged are
/// triangles lower than a 2^13th of the scene, unless a coordinate is the same at all their corners: rounding turns them too far.
/// Where very many lie in a plane, those are taken to cover each other, and where in very many planes next to each other, those
/// for which there is no time are said to be in no order (Conversion::close_faces). Takes time in proportion to the triangles.
///
/// Copies of base meshes are not looked at: they come with the planes that they have in their mesh
/// (core/database/meshes/mesh_faces.h).
///
/// `cells` lists the triangles of `scene`, which still has its objects. Returns whether there are any: then ids are others.
bool settle_coplanar(Conversion& conversion, const MacroCells& cells, const Scene& scene, const GridFrame& frame,
                     const Parallel& parallel);

}  // namespace dmpc::core
