// One primitive's values in a block, as its floats say.
#pragma once

#include <cstddef>

#include "core/base/vec.h"

namespace dmpc::core {

/// `rows` points at the block's first value, `stride` is its lane count.
struct BlockLane {
  const float* rows;
  std::size_t stride, lane;

  double value(std::size_t row) const { return double{rows[row * stride + lane]}; }
  /// A vertex, centre or end, by the row where it starts.
  Vec3d vector(std::size_t row) const { return {value(row), value(row + 1), value(row + 2)}; }
};

}  // namespace dmpc::core
