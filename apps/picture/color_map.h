// Colours for numbers: from dark blue over magenta and orange to light yellow, in steps that look alike.
#pragma once

#include "core/base/vec.h"

namespace dmpc::apps {

/// A colour of CIE 1976 L*a*b* with the white of daylight D65.
struct LabColor {
  double lightness = 0, a = 0, b = 0;
};

/// What stands for `position`, clamped to 0..1 (NaN: 0): the point so far along a line of straight pieces through CIELAB, on
/// which lightness only grows. Equal steps are equally far apart there (CIE76), which is what makes a map perceptually uniform;
/// see P. Kovesi, "Good Colour Maps: How to Design Them" (2015).
LabColor lab_color_map(double position);

/// The same as linear light of sRGB's primaries (IEC 61966-2-1), within 0..1.
core::Color color_map(double position);

}  // namespace dmpc::apps
