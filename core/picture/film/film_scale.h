// The scale of a scene's film: known before rendering, so that all nodes have the same.
#pragma once

#include <cstdint>

#include "core/picture/film/film.h"
#include "core/picture/surfaces/transport.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// A film has scale 1 if the bound of a sample's radiance lies between these.
inline constexpr double unscaled_bound_min = 0x1p-8, unscaled_bound_max = 0x1p31;

/// `radiance_bound`: the largest radiance of a sample (radiance_bound()); `bound_of_one_hit`: the part of it after one hit.
/// Within the bounds above, or if nothing is bounded, the scale is 1. Below them the scale brings the bound to between 1/2 and 1;
/// above, it brings the sum of samples_max samples to what a sum can hold. What mirrors and glass multiply counts only up to 2^20
/// times what one hit brings, or the film would be coarse for the sake of light that hardly any scene has.
FilmScale film_scale_for(double radiance_bound, double bound_of_one_hit, std::uint32_t samples_max);
/// For the scene, with hits up to this depth and at most samples_max samples per pixel.
FilmScale film_scale_for(const Scene& scene, int depth_max, std::uint32_t samples_max, const Transport& transport = {});

}  // namespace dmpc::core
