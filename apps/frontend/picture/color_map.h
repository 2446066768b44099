// Colours for numbers: "inferno", from black over purple and orange to light yellow, which people know from matplotlib.
#pragma once

#include "core/base/vec.h"

namespace dmpc::apps {

/// What stands for `position`, clamped to 0..1 (NaN: 0), as linear light of sRGB's primaries, within 0..1. Lightness grows with
/// the position, in steps that look alike (S. van der Walt, N. Smith, 2015). Thread-safe.
core::Color color_map(double position);

}  // namespace dmpc::apps
