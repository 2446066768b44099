// Axis-aligned boxes in single precision that hold what they bound: for cutting many primitives into few groups.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/box.h"

namespace dmpc::core {

/// The largest float that is not above `value`.
inline float rounded_down(double value) {
  const auto rounded = static_cast<float>(value);
  return double{rounded} <= value ? rounded : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}
/// The least float that is not below `value`.
inline float rounded_up(double value) { return -rounded_down(-value); }

/// Empty as constructed: low above high. Four numbers a corner, the last always 0, fill a register.
struct alignas(16) Bounds {
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<float, 4> low{infinity, infinity, infinity, 0};
  std::array<float, 4> high{-infinity, -infinity, -infinity, 0};

  /// Rounds outwards.
  static Bounds around(const Box& box) {
    Bounds bounds;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.low[axis] = rounded_down(box.low[axis]);
      bounds.high[axis] = rounded_up(box.high[axis]);
    }
    return bounds;
  }
  Box box() const {
    return {{double{low[0]}, double{low[1]}, double{low[2]}}, {double{high[0]}, double{high[1]}, double{high[2]}}};
  }
  void include(const Bounds& other) {
    for (std::size_t i = 0; i < 4; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
  /// What of this lies in `other`; the nearest part of its border if nothing does.
  Bounds clamped_to(const Bounds& other) const {
    Bounds bounds;
    for (std::size_t i = 0; i < 4; ++i) {
      bounds.low[i] = std::min(std::max(low[i], other.low[i]), other.high[i]);
      bounds.high[i] = std::min(std::max(high[i], other.low[i]), other.high[i]);
    }
    return bounds;
  }
  /// Twice the coordinate of the middle.
  float middle(std::size_t axis) const { return low[axis] + high[axis]; }
  /// Half the surface.
  float area() const {
    const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x * y + y * z + z * x;
  }
};

}  // namespace dmpc::core
