// How far a plain path tracer's picture lies from ours.
#pragma once

#include <string>

#include "apps/lab/bench/speed/plain_renderer.h"
#include "core/picture/film.h"

namespace dmpc::apps {

/// Root mean squares, linear: how far a plain picture lies from ours, and how noisy that is, as far as its two planes tell.
struct PathDistance {
  double apart = 0, noise = 0;
};

/// The most that pictures lie apart, over the noise of ours: most samples have one path in both.
inline constexpr double path_distance_max = 0.5;

/// Of our film of `scene`, of 16 samples a pixel or more. Throws core::InternalError if the pictures are further apart than
/// path_distance_max of its noise, or their means than a hundredth of the light.
PathDistance path_distance(const PlainPicture& picture, const core::Film& film, const std::string& scene);

}  // namespace dmpc::apps
