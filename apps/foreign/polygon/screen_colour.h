// Display-referred colours of scan formats.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/base/vec.h"

namespace dmpc::apps {

/// Red, green and blue, with float precision.
using Color = core::Vec3d;

/// The linear colour of elements without one, if other elements have colours.
inline constexpr Color colour_of_none = {double{0.6F}, double{0.6F}, double{0.6F}};

/// A placeholder for a missing colour until all are read.
inline constexpr Color not_yet = {-std::numeric_limits<double>::max(), 0, 0};

/// Sets the colour of the last of `count` faces or vertices; earlier ones without a colour stay without.
void set_last(std::vector<Color>& colors, std::size_t count, const Color& color);

/// Converts sRGB values from 0 to `most` into linear values from 0 to 1. MeshLab, Blender and three.js interpret the colours of
/// these formats so, whatever their type. If any of the `count` elements has a colour, those without get `plain`.
void make_linear(std::vector<Color>& colors, std::size_t count, double most, const Color& plain = colour_of_none);
Color linear_color(const Color& color, double most);

/// Returns the value of full intensity if the number type does not define it: 255 if any value exceeds 1, else 1.
double full_light(const std::vector<Color>& colors);

}  // namespace dmpc::apps
