// Which scale a scene's film has: known before anything is rendered, so that all who render it have the same.
#pragma once

#include <cstdint>

#include "core/picture/film/film.h"
#include "core/picture/surfaces/transport.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// Bounds of a sample's radiance between which a film has the scale 1.
inline constexpr double unscaled_bound_min = 0x1p-8, unscaled_bound_max = 0x1p31;

/// From what radiance a sample can have at most (radiance_bound()), so much of it after one hit. Within the bounds above, or
/// where nothing is bounded, the scale is 1. Below, it brings the bound to between 1/2 and 1; above, what so many samples of a
/// pixel can have to what a sum can hold. What mirrors and glass multiply has no share in that beyond 2^20 times what one hit
/// brings, or the film would be coarse for the sake of light that hardly any scene has.
FilmScale film_scale_for(double radiance_bound, double bound_of_one_hit, std::uint32_t samples_max);
/// Of the scene, if rays have hits up to this depth, and pixels at most so many samples.
FilmScale film_scale_for(const Scene& scene, int depth_max, std::uint32_t samples_max, const Transport& transport = {});

}  // namespace dmpc::core
