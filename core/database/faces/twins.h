// Triangles that are there many times over.
#pragma once

#include <array>
#include <compare>

#include "core/database/conversion.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// The corners of a triangle in an order of their own, by which equal triangles are equal whichever corner they begin with.
using SortedCorners = std::array<std::array<float, 3>, 3>;
SortedCorners sorted_corners(const PrimitiveValues& triangle);

/// Leaves out each triangle with the corners of an earlier one, if both let light through or neither does and doubles do not tell
/// their planes apart, and counts it as a duplicate: what settle_coplanar() would make of them in the end, and also those of one
/// object, which it leaves. Takes time and memory in proportion to the triangles, except for sorting: for where lists of all of them
/// would be long. Copies of base meshes stay. `scene` still has its objects. Returns whether there were any: then ids are others.
bool drop_twins(Conversion& conversion, const Scene& scene, const GridFrame& frame);

}  // namespace dmpc::core
