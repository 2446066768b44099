// Colour map "inferno" of matplotlib: from black over purple and orange to light yellow.
#pragma once

#include "core/base/vec.h"

namespace dmpc::apps {

/// Colour of `position`, clamped to 0..1 (NaN: 0), as linear light of sRGB's primaries, within 0..1. Lightness increases with the
/// position in perceptually uniform steps (S. van der Walt, N. Smith, 2015). Thread-safe.
core::Color color_map(double position);

}  // namespace dmpc::apps
