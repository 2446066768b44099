// Axis-aligned boxes in double precision, for building.
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "core/base/vec.h"

namespace dmpc::core {

/// Empty as constructed: low above high.
struct Box {
  Vec3d low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  Vec3d high = -low;

  bool empty() const { return !(low.x <= high.x); }
  /// By name: GCC has what is gathered in a loop over axes in memory.
  [[gnu::always_inline]] void include(const Vec3d& point) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
  }
  /// A ball about a center.
  void include(const Vec3d& center, double radius) {
    const Vec3d reach{radius, radius, radius};
    include(center - reach);
    include(center + reach);
  }
  static Box around(std::span<const Vec3d> points) {
    Box box;
    for (const Vec3d& point : points) {
      box.include(point);
    }
    return box;
  }
  /// Grows by `margin` to every side.
  Box padded(const Vec3d& margin) const { return {low - margin, high + margin}; }
  Vec3d center() const { return (low + high) * 0.5; }
  Vec3d half() const { return (high - low) * 0.5; }
  /// Border included; no point that is not a number.
  bool holds(const Vec3d& point) const {
    return point.x >= low.x && point.x <= high.x && point.y >= low.y && point.y <= high.y && point.z >= low.z &&
           point.z <= high.z;
  }
};

}  // namespace dmpc::core
