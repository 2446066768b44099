// What of a file's numbers a database takes.
#pragma once

#include <array>
#include <cmath>

#include "core/base/vec.h"

namespace dmpc::core {

/// A coordinate beyond this share of float's range cannot be brought into a grid.
inline constexpr double coordinate_max = 1e30;

inline bool usable(const Vec3d& v) {
  return std::fabs(v.x) < coordinate_max && std::fabs(v.y) < coordinate_max && std::fabs(v.z) < coordinate_max;
}

/// A place on a texture that is no number counts as the texture's corner; one that is too far away to be told from its
/// neighbours, too.
inline std::array<float, 2> usable_place(std::array<float, 2> place) {
  constexpr float place_max = 0x1p20F;
  for (float& coordinate : place) {
    coordinate = std::fabs(coordinate) < place_max ? coordinate : 0.0F;
  }
  return place;
}

}  // namespace dmpc::core
