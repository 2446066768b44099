// How high triangles are.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/vec.h"

namespace dmpc::core {

/// The least altitude of a triangle with these edges, in any order and direction; `twice_area` is that of it. Not a number if all
/// is 0.
inline double least_altitude(const Vec3d& a, const Vec3d& b, const Vec3d& c, double twice_area) {
  return twice_area / std::sqrt(std::max(std::max(dot(a, a), dot(b, b)), dot(c, c)));
}

}  // namespace dmpc::core
