// A seeded source of numbers, points and directions, the same on every machine.
#pragma once

#include <cstdint>

#include "core/base/sampling.h"
#include "core/base/vec.h"

namespace dmpc::apps {

/// A hashed counter: equal seeds give equal sequences.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ULL) {}

  std::uint64_t bits() { return core::mix(state_ += 0x9e3779b97f4a7c15ULL); }
  /// Returns a number in [0, 1).
  double unit() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Returns a number below `count`, which is above 0.
  std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(bits() % count); }
  core::Vec3d in_box(double low, double high) {
    const double x = between(low, high), y = between(low, high);
    return {x, y, between(low, high)};
  }
  /// Returns a unit vector, uniform over the sphere.
  core::Vec3d direction() {
    for (;;) {
      const core::Vec3d v = in_box(-1, 1);
      if (const double size = core::length(v); size > 0.01 && size <= 1) {
        return v * (1.0 / size);
      }
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace dmpc::apps
