// A block's primitives as its record holds them.
#pragma once

#include <cstddef>

#include "core/base/box.h"
#include "core/database/database.h"
#include "core/database/overlap.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Without its plane.
inline PrimitiveValues primitive_in(const std::byte* block, std::size_t lane) {
  const auto header = read<BlockHeader>(block);
  PrimitiveValues primitive{.kind = header.kind};
  for (std::size_t row = 0; row < value_count(header.kind); ++row) {
    primitive.value[row] = read<float>(block + sizeof(header) + sizeof(float) * (row * header.count + lane));
  }
  return primitive;
}

/// The box around all of them, not padded.
inline Box bounds_of_block(const std::byte* block) {
  Box bounds;
  for (std::size_t lane = 0; lane < read<BlockHeader>(block).count; ++lane) {
    const Box lane_bounds = bounds_of(primitive_in(block, lane));
    bounds.include(lane_bounds.low);
    bounds.include(lane_bounds.high);
  }
  return bounds;
}

}  // namespace dmpc::core
