// The primitives of a leaf's record.
#pragma once

#include <cstddef>

#include "core/base/box.h"
#include "core/database/database.h"
#include "core/database/tree/overlap.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Without its plane.
inline PrimitiveValues primitive_in(const std::byte* leaf, std::size_t lane) {
  const auto header = read<LeafHeader>(leaf);
  PrimitiveValues primitive{.kind = header.kind};
  for (std::size_t row = 0; row < value_count(header.kind); ++row) {
    primitive.value[row] = read<float>(leaf + sizeof(header) + sizeof(float) * (row * header.count + lane));
  }
  return primitive;
}

/// The box around all of them, not padded.
inline Box bounds_of_leaf(const std::byte* leaf) {
  Box bounds;
  for (std::size_t lane = 0; lane < read<LeafHeader>(leaf).count; ++lane) {
    const Box lane_bounds = bounds_of(primitive_in(leaf, lane));
    bounds.include(lane_bounds.low);
    bounds.include(lane_bounds.high);
  }
  return bounds;
}

}  // namespace dmpc::core
