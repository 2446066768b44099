// Pseudo-random numbers that are the same everywhere.
#pragma once

#include <cstdint>

#include "core/base/sampling.h"

namespace dmpc::apps {

/// A sequence of numbers in multiples of 2^-24.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(core::mix(seed + 1)) {}

  /// In [0, 1).
  double share() {
    state_ += 0x9e3779b97f4a7c15ULL;
    return static_cast<double>(core::mix(state_) >> 40U) * 0x1p-24;
  }
  /// In [-1, 1).
  double signed_share() { return 2 * share() - 1; }

 private:
  std::uint64_t state_;
};

}  // namespace dmpc::apps
