// Triangles that cover each other in one plane: a rug on the floor, a box that stands on it, a face that occurs twice.
#pragma once

#include "core/database/conversion.h"
#include "core/database/grid/macro_cells.h"
#include "core/database/parallel.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// With rounding, now the one and now the other would be nearer. So triangles that cover each other and lie in one plane, up to
/// the rounding of their corners to float, share a FacePlane, by which a ray hits all of them at the same t, and the least id
/// wins. Ids follow the file's order: the earlier shows. But an emitter gets an earlier id than the faces it lies on, and a
/// transparent face a later one (Material::rank_in_plane()), and takes its place in the file's order. Of triangles with the same
/// three corners only the first is kept. Emitters that are fully visible are noted (Conversion::whole_lamps).
///
/// What the file's doubles tell apart stays apart, such as a poster before a wall or the two sides of a pane: where faces that
/// cover each other are in one plane for floats but not for doubles, or nearer than rays start off a triangle, they and all
/// triangles of their polygons get the planes given by doubles (core/database/faces/face_stack.h); those in each plane are
/// settled by themselves, as above. So are faces that are so near to these that layers move a t as far, and those near to them.
///
/// Sharing an edge or a corner is not covering. Without triangles that cover each other nothing changes. Triangles lower than a
/// 2^13th of the scene are not judged, unless a coordinate is the same at all their corners: rounding turns them too far. Where
/// very many lie in a plane, these are assumed to cover each other, and where they lie in very many planes next to each other,
/// those for which there is no time are reported as unordered (Conversion::close_faces). Takes time in proportion to the
/// triangles.
///
/// Copies of base meshes are skipped: they have the planes of their mesh (core/database/meshes/mesh_faces.h).
///
/// `cells` lists the triangles of `scene`, which still has its objects. Returns whether there are any: then ids change.
bool settle_coplanar(Conversion& conversion, const MacroCells& cells, const Scene& scene, const GridFrame& frame,
                     const Parallel& parallel);

}  // namespace dmpc::core
