// How far a film is from another.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/picture/film/film.h"

namespace dmpc::tests {

/// The error of radiance, over pixels and channels. Films of one size with samples everywhere.
inline double root_mean_square(const core::Film& film, const core::Film& truth) {
  double sum = 0;
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    const core::Vec3d difference = film.radiance(pixel) - truth.radiance(pixel);
    sum += dot(difference, difference) / 3;
  }
  return std::sqrt(sum / static_cast<double>(film.pixel_count()));
}

}  // namespace dmpc::tests
