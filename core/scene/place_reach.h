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

/// A box, in the directions of `axes`, that holds all corners of a mesh with the box `own`, as doubles have them in their place.
/// Numbers that are none where doubles end, which no other box holds.
inline Box reach_of(const Box& own, const Transform& world, const GridAxes& axes = world_axes) {
  constexpr double rounding = 0x1p-40;  // of what is added up: far more than doubles lose
  const Vec3d middle = turned(axes, world.point(own.center())), half = own.half(), largest = magnitudes(own.center()) + half;
  Box reach;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double away = 0, added_up = 0;
    for (std::size_t row = 0; row < 3; ++row) {
      const Vec3d way = magnitudes(world.rows[row]) * std::fabs(axes[axis][row]);
      away += dot(way, half);
      added_up += dot(way, largest) + std::fabs(world.shift[row] * axes[axis][row]);
    }
    away += added_up * rounding;
    reach.low[axis] = middle[axis] - away;
    reach.high[axis] = middle[axis] + away;
  }
  return reach;
}

}  // namespace dmpc::core
