// The effect of rounding coordinates to float on a picture, in pixels.
#pragma once

#include <cstdint>

#include "core/database/database.h"
#include "core/picture/camera/camera.h"

namespace dmpc::core {

/// Rounding that moves nothing by more pixels than this changes at most about one in a thousand of them.
inline constexpr double rounding_allowed_pixels = 0x1p-8;

/// For primary visibility, as seen by the eye. Nothing where a scene is not much larger than its details, or local zero lies
/// among them (core/scene/detail.h).
struct RoundingLoss {
  std::uint64_t moved = 0;      ///< primitives that may be off by more than rounding_allowed_pixels
  double moved_pixels = 0;      ///< the largest shift
  std::uint64_t collapsed = 0;  ///< primitives that are left out because their corners or ends coincide
  double collapsed_pixels = 0;  ///< size of the largest of them; 0 if all are behind the eye
  std::uint64_t swapped = 0;    ///< faces that may show where another one that covers them is nearer, or be hidden by it
  double swapped_pixels = 0;    ///< the largest extent of that

  bool is_none() const { return moved == 0 && collapsed == 0 && swapped == 0; }
};

/// The loss of a database that has its primitives. Takes hardly any time if the eye is well outside the scene, otherwise some
/// nanoseconds per primitive.
RoundingLoss find_rounding_loss(const Database& database, const Camera& camera);

}  // namespace dmpc::core
