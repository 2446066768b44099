// A mountain landscape around a lake: heights and colours as functions of the position, bit-identical on every machine.
#pragma once

#include "core/base/vec.h"

namespace dmpc::apps {

/// Height of the lake's surface; y is up.
inline constexpr double lake_height = 0.03;

/// Height of the ground at (x, z); intended for x from -1 to 1 and z from -1/2 to 1/2, where it is from 0 to about 0.4. A ridged
/// multifractal (F. K. Musgrave in Ebert and others, "Texturing and Modeling", 1994) of gradient noise (K. Perlin, "Improving
/// Noise", 2002), flattened to a basin.
double ground_height(double x, double z);

/// A unit normal from differences of heights `step` away on both sides; `step` > 0.
core::Vec3d ground_normal(double x, double z, double step);

/// Linear red, green, blue, 0 to 1, of ground of this height: sand around the lake, then grass, rock on steep ground, and snow.
/// `upright` is the y of the ground's unit normal.
core::Vec3d ground_color(double x, double z, double height, double upright);

}  // namespace dmpc::apps
