// Point lights as emitting spheres.
#pragma once

#include <cstdint>

#include "core/scene/scene.h"

namespace dmpc::core {

inline constexpr double far_light_diagonals = 100;
/// Relative to the diagonal of the box of all objects: smaller spheres hardly exist in its coordinates, and the radiance that
/// they would need leaves no steps for the rest of the picture.
inline constexpr double small_light_share = 0x1p-20;

/// Replaces each point light by a black sphere of this radius around it, in the scene's units and above 0. Light of a sphere
/// falls off, that of NFF's points does not; so its emission is intensity (d / radius)^2, where d is the distance to the middle
/// of the box of all objects, or the radius if that is more: there it gives the light of the point. A light that falls off gives
/// the same light everywhere. Lights nearer to the eye than the radius, which would be inside, and spot lights stay points, as do
/// all in a scene without objects, and those farther from that middle than far_light_diagonals of the box; if the radius is below
/// small_light_share of that, all stay. Returns how many stay.
std::uint64_t make_lights_spheres(Scene& scene, double radius);

}  // namespace dmpc::core
