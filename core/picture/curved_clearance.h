// How far off a curved surface rays start.
#pragma once

#include "core/picture/hit_state.h"
#include "core/picture/triangle_hit.h"

namespace dmpc::core {

// By the largest coordinate and radius: curved surfaces are solved in double from rays that are exact to 2^-49, but other
// surfaces that go on there may be off by a few times what rounding takes of a value with its rest.
inline constexpr double curved_clearance = 0x1p-40, curved_going_on = 0x1p-28;
/// Of one that passes by local zero (core/record/passing_surface.h), far less: others that go on there are off by a share of the
/// way from local zero, and what is next to it may be small.
inline constexpr double passing_clearance = 0x1p-44, passing_going_on = 0x1p-22;

/// `size`: the largest coordinate and radius; `radius`: of the surface where it was hit.
inline Clearance clearance_on_curved(const HitState& state, double size, double radius, bool passes_by) {
  const double tie = tie_clearance * double{state.hit.t};
  if (passes_by) {
    return {passing_clearance * size + passing_going_on * largest_component(state.point) + tie, passing_clearance * size, radius};
  }
  return {curved_going_on * size + tie, curved_clearance * size, radius};
}

}  // namespace dmpc::core
