// The light of pixels whose primary rays need not be traced.
#pragma once

#include <cstdint>

#include "core/picture/film.h"
#include "core/picture/pixel_task.h"
#include "core/trace/operations.h"

namespace dmpc::core {

/// What each of `pixels` pixels of settings.background has, with the samples of the first pass; counted as if a task had rendered
/// every one. Requires that settings.shows_background() them, and that they are alike: settings.is_beyond_alike(). Thread safety:
/// pure but for the counts.
inline PixelSums background_sums(std::uint64_t pixels, const RenderSettings& settings, Operations& operations) {
  const SampleRange samples = settings.first_samples();
  PixelSums sums;
  Operations of_one;
  for (std::uint32_t i = 0; i < samples.count; ++i) {
    const Ray ray{.sample = static_cast<std::uint16_t>(samples.first + i)};
    deposit(sums, ray, settings.light_of_miss(ray), settings, of_one);
  }
  operations.rays[static_cast<std::size_t>(RayKind::primary)] += pixels * samples.count;
  operations.skipped.background += pixels * samples.count;
  operations.deposits_saturated += pixels * of_one.deposits_saturated;
  return sums;
}

}  // namespace dmpc::core
