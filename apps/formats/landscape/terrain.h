// A mountain landscape around a lake: heights and colours as functions of the place, the same to the last bit on every machine.
#pragma once

#include "core/base/vec.h"

namespace dmpc::apps {

/// Where the lake's surface lies; y is up.
inline constexpr double lake_height = 0.03;

/// How high the ground is at (x, z); meant for x from -1 to 1 and z from -1/2 to 1/2, where it is from 0 to about 0.4. A ridged
/// multifractal (F. K. Musgrave in Ebert and others, "Texturing and Modeling", 1994) of gradient noise (K. Perlin, "Improving
/// Noise", 2002), flattened to a basin.
double ground_height(double x, double z);

/// A normal of unit length, by differences of heights `step` away to both sides; `step` > 0.
core::Vec3d ground_normal(double x, double z, double step);

/// Linear red, green, blue, 0 to 1, of ground of this height: sand about the lake, then grass, rock where it is steep, and snow.
/// `upright` is the y of the ground's unit normal.
core::Vec3d ground_color(double x, double z, double height, double upright);

}  // namespace dmpc::apps
