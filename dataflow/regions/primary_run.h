// Primary rays by their numbers.
#pragma once

#include <cstdint>

#include "core/picture/sampling/sample_pass.h"

namespace dmpc::dataflow {

/// Consecutive primary rays of a pass. They are numbered by the samples that some pixel of it may have: for `count` samples from
/// `first` on, the ray of sample `first + i` of a pixel has the number place * count + i, by its place in the PixelOrder.
struct PrimaryRun {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// From 0 to the last of any pixel of the pass, since pixels differ.
inline core::SampleRange numbered_samples(const core::Pass& pass) { return {0, pass.samples_end()}; }

constexpr std::uint32_t place_of(std::uint64_t number, const core::SampleRange& samples) {
  return static_cast<std::uint32_t>(number / samples.count);
}
constexpr std::uint32_t sample_of(std::uint64_t number, const core::SampleRange& samples) {
  return samples.first + static_cast<std::uint32_t>(number % samples.count);
}

}  // namespace dmpc::dataflow
