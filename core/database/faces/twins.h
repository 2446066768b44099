// Duplicate triangles.
#pragma once

#include <array>
#include <compare>

#include "core/database/conversion.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// The corners of a triangle in a canonical order: equal triangles are equal with any first corner.
using SortedCorners = std::array<std::array<float, 3>, 3>;
SortedCorners sorted_corners(const PrimitiveValues& triangle);

/// Removes each triangle with the corners of an earlier one, if both are transparent or neither is and doubles do not tell their
/// planes apart, and counts it as a duplicate: what settle_coplanar() would do in the end, and also for triangles of one object,
/// which it leaves. Takes time and memory in proportion to the triangles, plus sorting: for scenes where lists of all of them
/// would be long. Copies of base meshes stay. `scene` still has its objects. Returns whether there were any: then ids change.
bool drop_twins(Conversion& conversion, const Scene& scene, const GridFrame& frame);

}  // namespace dmpc::core
