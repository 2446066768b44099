// From a node's coordinates to the world's.
#pragma once

#include "core/scene/transform.h"

namespace dmpc::apps {

using core::Transform;

/// First `inner`, then `outer`.
inline Transform composed(const Transform& outer, const Transform& inner) {
  Transform product;
  for (std::size_t row = 0; row < 3; ++row) {
    const core::Vec3d& by = outer.rows[row];
    product.rows[row] = inner.rows[0] * by.x + inner.rows[1] * by.y + inner.rows[2] * by.z;
  }
  product.shift = outer.point(inner.shift);
  return product;
}

}  // namespace dmpc::apps
