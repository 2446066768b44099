// What rounding coordinates to float takes from a picture, in its pixels.
#pragma once

#include <cstdint>

#include "core/database/database.h"
#include "core/picture/camera/camera.h"

namespace dmpc::core {

/// Rounding that moves nothing by more pixels changes no more than about one in a thousand of them.
inline constexpr double rounding_allowed_pixels = 0x1p-8;

/// What is seen directly, as the eye sees it. Nothing where a scene is of a size with its details, or local zero lies among them
/// (core/scene/detail.h).
struct RoundingLoss {
  std::uint64_t moved = 0;      ///< primitives that may be off by more than rounding_allowed_pixels
  double moved_pixels = 0;      ///< how far any of them, at most
  std::uint64_t collapsed = 0;  ///< primitives that are left out since their corners or ends fell together
  double collapsed_pixels = 0;  ///< how large the largest of them would be; 0 if all are behind the eye
  std::uint64_t swapped = 0;    ///< faces that may show where another one, which covers them, is nearer, or be hidden by it
  double swapped_pixels = 0;    ///< how far across that is, at most

  bool is_none() const { return moved == 0 && collapsed == 0 && swapped == 0; }
};

/// What rounding takes of a database that has its primitives. It takes next to no time if the eye is well outside the scene, else
/// some nanoseconds a primitive.
RoundingLoss find_rounding_loss(const Database& database, const Camera& camera);

}  // namespace dmpc::core
