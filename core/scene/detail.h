// Where a scene's detail is, if it is in one place that is small beside the whole.
#pragma once

#include <optional>

#include "core/base/box.h"
#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// Detail lies close together if three quarters of it lie within this share of the scene's extent.
inline constexpr double close_share = 0x1p-8;

/// The place about which a scene's small objects lie close together; nothing if they are spread
/// over it. An object of size s counts 1/s^2 times, so that one large beside many small ones does not matter, and not at all if
/// it has no size. `bounds` are the scene's. Follows from the objects alone, and scales with them to the last bit by powers of
/// two.
std::optional<Vec3d> place_of_detail(const Scene& scene, const Box& bounds);

}  // namespace dmpc::core
