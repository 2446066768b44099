// The converged picture of a scene, against which errors are measured: double precision, many samples.
#pragma once

#include <cstddef>
#include <cstdint>

#include "apps/lab/oracle/reference/picture.h"
#include "apps/picture/image_file.h"
#include "apps/scene/picture_options.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

struct ReferenceOptions {
  std::uint32_t samples_a_side = 16;  ///< n for n x n samples a pixel: even, 2 to 128
  std::uint64_t seed = 1;             ///< another seed gives other, equally good samples
};

/// A picture of n x n samples a pixel, in two independent halves A and B: n x n/2 and n/2 x n strata with one random sample each.
/// The picture is (A + B) / 2. Since A and B have the same mean, the variance of (A - B) / 2 is that of (A + B) / 2, so its size
/// says how far the picture is from the one with infinitely many samples.
struct Reference {
  Image picture;         ///< linear radiance, rounded to float at the end
  Image difference;      ///< (A - B) / 2, rounded as well
  double own_error = 0;  ///< root mean square of (A - B) / 2 over all channels of all pixels, to compare with an RMSE
  /// Mean of ((A - B) / 2)^2 / (picture + 0.01)^2, to compare with PictureError::relative_mean_square.
  double own_relative_mean_square = 0;
  std::uint64_t rays = 0;  ///< traced for the picture, of all kinds
  double seconds = 0;      ///< wall clock
};

/// The differences of two halves, summed over pixels.
struct HalvesSum {
  double squares = 0, relative_squares = 0;

  /// Adds a pixel of both halves to the sums and to the reference's images, which have its size.
  void add(std::size_t pixel, const core::Vec3d& a, const core::Vec3d& b, Reference& reference);
  /// Sets the reference's own errors, from all pixels of its picture.
  void finish(Reference& reference) const;
};

/// Returns the reference of `scene` with the resolution (the view's own if not given), depth and convention of `picture`; its
/// samples and scene name are not used. It is computed with all cores, in double precision and world coordinates (tracer.h); the
/// bits are the same for every number of cores. Progress counts rows of both halves. Throws Interrupted when a stop is requested.
Reference reference_for(const core::Scene& scene, const PictureOptions& picture, const ReferenceOptions& options,
                        const Attendance& attendance = {});

}  // namespace dmpc::apps
