// Where an eye lies on a sphere, a cone or a cylinder: it sees what lies around it, not the spot where it is.
#pragma once

#include <cmath>

#include "core/record/curved_values.h"

namespace dmpc::core {

/// Whether it is nearer to the surface than rounding may have moved that. `off_squared`: the square of its distance from the
/// centre or axis, less that of the radius there; `size`: the largest coordinate and radius.
inline bool is_on_surface(const CurvedValues& curved, double off_squared, double radius, double size) {
  constexpr double moved = 0x1p-30, moved_passing = 0x1p-46;
  return std::fabs(off_squared) <= (curved.passes_by() ? moved_passing : moved) * size * std::fabs(radius);
}

}  // namespace dmpc::core
