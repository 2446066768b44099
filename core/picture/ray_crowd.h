// Whether a picture's hits send rays, and if they are too many to finish, from which depth they are to send fewer.
#pragma once

#include <cstdint>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"

namespace dmpc::core {

/// A picture is crowded if its samples have more rays than this on average.
inline constexpr std::uint64_t crowd_rays = 16384;
/// From this depth on hits of a crowded picture that could send two rays send one (ShadeOptions::one_child_from): of 20 depths,
/// hits at the first 8 (255 at most) send two, and the 256 paths then go on alone.
inline constexpr std::uint8_t crowd_depth = 9;

/// crowd_depth if the picture is crowded, judged by some of its pixels, else 0. Depends only on picture and scene, so every node
/// finds the same. Renders pixels only where a material both mirrors and transmits and rays go deeper than that, and shoots at
/// most a million rays. Reads database.bytes(). Thread safety: pure.
std::uint8_t find_one_child_depth(const Database& database, const RenderSettings& settings);

/// Whether a material of the scene may reflect or transmit rays. Reads database.bytes(). Thread safety: pure.
bool has_reflection_or_transmission(const Database& database);

}  // namespace dmpc::core
