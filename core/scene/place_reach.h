// How far a mesh reaches where it is placed, without a look at its corners.
#pragma once

#include <cmath>
#include <cstddef>

#include "core/base/box.h"
#include "core/record/record.h"
#include "core/scene/frame.h"
#include "core/scene/transform.h"

namespace dmpc::core {

inline Vec3d magnitudes(const Vec3d& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

/// A box that holds all corners of a mesh with the box `own`, as doubles have them in their place.
/// Numbers that are none where doubles end, which no other box holds.
inline Box reach_of(const Box& own, const Transform& world) {
  constexpr double rounding = 0x1p-40;  // of what is added up: far more than doubles lose
  const Vec3d middle = world.point(own.center()), half = own.half(), largest = magnitudes(own.center()) + half;
  Box reach;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3d way = magnitudes(world.rows[axis]);
    const double away = dot(way, half) + (dot(way, largest) + std::fabs(world.shift[axis])) * rounding;
    reach.low[axis] = middle[axis] - away;
    reach.high[axis] = middle[axis] + away;
  }
  return reach;
}

}  // namespace dmpc::core
