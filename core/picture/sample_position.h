// Where in its pixel a sample lies.
#pragma once

#include <cstdint>

#include "core/picture/sample_pair.h"

namespace dmpc::core {

/// In a pixel whose sides are 1 long.
using SamplePosition = SamplePair;

/// Pair 0 of the sample's numbers: of those that follow each other a pixel's plane is filled evenly.
inline SamplePosition sample_position(std::uint32_t pixel, std::uint32_t sample) { return sample_pair(pixel, sample, 0); }

}  // namespace dmpc::core
