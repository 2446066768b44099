// Point lights as spheres that shine.
#pragma once

#include <cstdint>

#include "core/scene/scene.h"

namespace dmpc::core {

inline constexpr double far_light_diagonals = 100;
/// Of the diagonal of the box of all objects: smaller spheres are hardly there in its coordinates, while what they must shine
/// with to light as the points did leaves no steps for the rest of the picture.
inline constexpr double small_light_share = 0x1p-20;

/// Makes of each point light a black sphere of this radius about it, in the scene's units and above 0. Light of a sphere falls
/// off, that of NFF's points does not; so it shines with intensity (d / radius)^2, d being the way to the middle of the box of
/// all objects, or the radius if that is more: there it lights what the point did. One that falls off lights as it did anywhere.
/// Lights nearer to the eye than the radius, which would be within, and such as shine in a cone, stay points, as all do in a
/// scene without objects, and those farther from that middle than far_light_diagonals of the box; where the radius is below
/// small_light_share of that, all stay. Returns how many stay.
std::uint64_t make_lights_spheres(Scene& scene, double radius);

}  // namespace dmpc::core
