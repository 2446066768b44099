// The rays of a bundle and the spheres or cones of a leaf: what a ray may meet is solved, some pairs side by side.
#pragma once

#include <cstddef>

#include "core/base/vector_width.h"
#include "core/trace/bundle.h"
#include "core/trace/curved_reach.h"

namespace dmpc::core {

inline const VectorWidth fastest_width = vector_width();

/// Merges hits with the leaf at `record` (with address `leaf`) into `best` and `found`, with the bits that test_leaf() finds for
/// each of the rays.
void hit_curved(RayBundle& bundle, const std::byte* record, Address leaf, RayMask rays, CurvedReach reach = reach_curved,
                VectorWidth width = fastest_width);

}  // namespace dmpc::core
