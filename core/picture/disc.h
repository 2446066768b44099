// From a square to a disc.
#pragma once

#include "core/base/vec.h"
#include "core/picture/sample_pair.h"

namespace dmpc::core {

/// A place on the unit disc.
struct DiscPlace {
  double x, y;
  double square;  ///< of its distance from the middle
};

/// For a pair that is as likely anywhere, one that is, too: P. Shirley, K. Chiu, "A Low Distortion Map Between Disk and Square",
/// Journal of Graphics Tools 2 (3), 1997.
DiscPlace on_disc(const SamplePair& pair);

/// `across.x`, `across.y` and `along` on axes at right angles, of which the last is the unit vector `axis`: T. Duff and others,
/// "Building an Orthonormal Basis, Revisited", Journal of Computer Graphics Techniques 6 (1), 2017.
Vec3d about_axis(const Vec3d& axis, double x, double y, double along);

}  // namespace dmpc::core
