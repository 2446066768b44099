// Whether a picture's hits send so many rays that it would not end, and from which depth on they are to send fewer.
#pragma once

#include <cstdint>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"

namespace dmpc::core {

/// Where samples have more rays than this on average, the picture is crowded.
inline constexpr std::uint64_t crowd_rays = 16384;
/// From this depth on hits of a crowded picture that could send two rays send one of them (ShadeOptions::one_child_from): of 20
/// depths 255 hits send two, and 256 ways go on alone.
inline constexpr std::uint8_t crowd_depth = 9;

/// crowd_depth if the picture is crowded, judged by some of its pixels, else 0. Depends on picture and scene alone, so everybody
/// finds the same. Looks at pixels only where a material both mirrors and lets light through and rays go deeper than that, and
/// shoots a million rays at most. Reads database.bytes(). Thread safety: pure.
std::uint8_t find_one_child_depth(const Database& database, const RenderSettings& settings);

}  // namespace dmpc::core
