// Which of a leaf's spheres and cones a ray may meet: a quick test with floats that leaves few to be solved.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/trace/bundle.h"

namespace dmpc::core {

/// The spheres or cones of a leaf, readable for overread_bytes behind.
struct CurvedRows {
  PrimitiveKind kind;
  const float* rows;
  std::size_t count;
};

/// For each ray of `asked`, a bit for each primitive that it may hit at a t in (0, t_most[ray]]: all that it hits there, and some
/// more. Returns the rays that have any. The same on every processor only up to rounding.
using CurvedReach = RayMask (*)(const CurvedRows& curved, const Ray* rays, RayMask asked, const float* t_most, RayMask* reached);
/// The fastest for this processor.
extern const CurvedReach reach_curved;
/// That for instruction set number `rank` that this processor has, the fastest first; nullptr if it has no more.
CurvedReach curved_reach(std::size_t rank);

}  // namespace dmpc::core
