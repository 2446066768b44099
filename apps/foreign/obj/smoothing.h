// Normals of smoothing groups.
#pragma once

#include <vector>

#include "apps/foreign/obj/geometry.h"
#include "core/base/vec.h"

namespace dmpc::apps::obj {

/// A normal for each corner, perhaps not of unit length: faces of one group that have none of their own are smooth among
/// themselves (apps/foreign/mesh/smooth.h, whatever the angle); 0 for all others. Empty if there are no such faces.
std::vector<core::Vec3d> group_normals(const std::vector<core::Vec3d>& vertices, const Faces& faces);

}  // namespace dmpc::apps::obj
