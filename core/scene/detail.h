// The place of a scene's detail, if it is concentrated in one that is small beside the whole.
#pragma once

#include <optional>

#include "core/base/box.h"
#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// Detail is concentrated if three quarters of it lie within this share of the scene's extent.
inline constexpr double close_share = 0x1p-8;

/// The place around which a scene's small objects are concentrated; nothing if they are spread over it. An object of size s has
/// weight 1/s^2, so that a large one beside many small ones does not matter, and weight 0 if it has no size. `bounds` are the
/// scene's. Depends only on the objects, and scales with them to the last bit by powers of two.
std::optional<Vec3d> place_of_detail(const Scene& scene, const Box& bounds);

}  // namespace dmpc::core
