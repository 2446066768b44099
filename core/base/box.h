// Axis-aligned boxes in double and single precision.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
  /// The components are named because GCC moves data that a loop over axes gathers into memory.
  [[gnu::always_inline]] void include(const Vec3d& point) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
  }
  /// Includes a ball around `center`.
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
  /// The box grown by `margin` on every side.
  Box padded(const Vec3d& margin) const { return {low - margin, high + margin}; }
  Vec3d center() const { return (low + high) * 0.5; }
  Vec3d half() const { return (high - low) * 0.5; }
  /// The border belongs to the box; a point with a NaN never does.
  bool holds(const Vec3d& point) const {
    return point.x >= low.x && point.x <= high.x && point.y >= low.y && point.y <= high.y && point.z >= low.z &&
           point.z <= high.z;
  }
};

/// The largest float that is not above `value`.
inline float rounded_down(double value) {
  const auto rounded = static_cast<float>(value);
  return double{rounded} <= value ? rounded : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}
/// The least float that is not below `value`.
inline float rounded_up(double value) { return -rounded_down(-value); }

/// Empty as constructed: low above high. Each corner has four numbers, the last always 0, and fills a register.
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
  /// The intersection with `other`; if it is empty, the nearest part of this box's border.
  Bounds clamped_to(const Bounds& other) const {
    Bounds bounds;
    for (std::size_t i = 0; i < 4; ++i) {
      bounds.low[i] = std::min(std::max(low[i], other.low[i]), other.high[i]);
      bounds.high[i] = std::min(std::max(high[i], other.low[i]), other.high[i]);
    }
    return bounds;
  }
  /// Twice the coordinate of the centre.
  float middle(std::size_t axis) const { return low[axis] + high[axis]; }
  /// Half the surface area.
  float area() const {
    const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x * y + y * z + z * x;
  }
};

}  // namespace dmpc::core
