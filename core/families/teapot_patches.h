// M. Newell's teapot as data: control points and, for each bicubic Bezier patch, the indices of its sixteen.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/vec.h"

namespace dmpc::core::scenes {

/// Indices into teapot_points: 4 r + c is row r along s, column c along t.
using TeapotPatch = std::array<std::uint16_t, 16>;

/// z up, the foot at z = 0, the lid's tip at z = 3.15.
extern const std::array<Vec3d, 290> teapot_points;
/// 4 of the rim, 8 of the body, 4 of the handle, 4 of the spout, 8 of the lid, 4 of the (added) bottom.
extern const std::array<TeapotPatch, 32> teapot_patches;

}  // namespace dmpc::core::scenes
