// Whether the normals at a face's corners add anything.
#pragma once

#include <span>

#include "core/base/vec.h"

namespace dmpc::core {

/// Whether a face looks the same without them: all are equal and perpendicular to its plane up to rounding to a few digits, or
/// are 0. Cards of leaves have equal normals that point elsewhere. There is one normal of any length for each corner, and at
/// least one.
bool are_the_faces_own(std::span<const Vec3d> normals, std::span<const Vec3d> corners);

}  // namespace dmpc::core
