// Primary rays by their numbers.
#pragma once

#include <cstdint>

#include "core/picture/refinement.h"

namespace dmpc::dataflow {

/// Consecutive primary rays of a pass. The ray of sample `first + i` of a pixel, in a pass of `count` samples from `first` on,
/// has the number pixel * count + i.
struct PrimaryRun {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

constexpr std::uint32_t pixel_of(std::uint64_t number, const core::SampleRange& samples) {
  return static_cast<std::uint32_t>(number / samples.count);
}
constexpr std::uint32_t sample_of(std::uint64_t number, const core::SampleRange& samples) {
  return samples.first + static_cast<std::uint32_t>(number % samples.count);
}

}  // namespace dmpc::dataflow
