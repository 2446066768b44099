// Colours as files of scans have them: for a screen.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/base/vec.h"

namespace dmpc::apps {

/// Red, green and blue, floats.
using Color = core::Vec3d;

/// Colour of elements without one beside others that have one: linear.
inline constexpr Color colour_of_none = {double{0.6F}, double{0.6F}, double{0.6F}};

/// Placeholder for a missing colour until all are read.
inline constexpr Color not_yet = {-std::numeric_limits<double>::max(), 0, 0};

/// Gives the last of `count` faces or vertices a colour; those before it that have none stay without.
void set_last(std::vector<Color>& colors, std::size_t count, const Color& color);

/// Makes linear, 0 to 1, what is on the sRGB curve, from 0 to `most`. MeshLab, Blender and three.js take the colours of such
/// files so, whatever type they have. Where any of `count` has a colour, those without get `plain`.
void make_linear(std::vector<Color>& colors, std::size_t count, double most, const Color& plain = colour_of_none);
Color linear_color(const Color& color, double most);

/// What stands for full light where the type of the numbers does not say it: 255 if any is beyond 1, else 1.
double full_light(const std::vector<Color>& colors);

}  // namespace dmpc::apps
