// What the normals at a face's corners say.
#pragma once

#include <span>

#include "core/base/vec.h"

namespace dmpc::core {

/// Whether a face looks as it would without them: all are alike and stand on its plane except for what writing them in a few digits
/// has done to them, or are 0. Cards of leaves have normals that are alike, and point elsewhere. A normal for each corner, of any
/// length; at least one.
bool are_the_faces_own(std::span<const Vec3d> normals, std::span<const Vec3d> corners);

}  // namespace dmpc::core
