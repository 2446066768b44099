// Colours as files of scans have them: for a screen.
#pragma once

#include <array>
#include <vector>

namespace dmpc::apps {

/// Red, green and blue.
using Color = std::array<float, 3>;

/// Of what has none beside others that have one: linear.
inline constexpr Color colour_of_none = {0.6F, 0.6F, 0.6F};

/// Makes linear, 0 to 1, what is on the sRGB curve, from 0 to `most`. MeshLab, Blender and three.js take the colours of such
/// files so, whatever type they have.
void make_linear(std::vector<Color>& colors, double most);
Color linear_color(const Color& color, double most);

/// What stands for full light where the type of the numbers does not say it: 255 if any is beyond 1, else 1.
double full_light(const std::vector<Color>& colors);

}  // namespace dmpc::apps
