// The converged picture of a scene, which errors are measured against: double precision, many samples, kept between runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "apps/lab/oracle/accurate/picture.h"
#include "apps/picture/image_file.h"
#include "apps/scene/picture_options.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

struct ReferenceOptions {
  std::uint32_t samples_a_side = 16;  ///< n for n x n samples a pixel: even, 2 to 128
  std::uint64_t seed = 1;             ///< other samples, as good as these
  /// Where references are kept; default_reference_folder() if not given, nowhere if there is none.
  std::optional<std::filesystem::path> folder;
};

/// A picture of n x n samples a pixel, in two halves A and B that know nothing of each other: n x n/2 and n/2 x n strata with one
/// random sample each. The picture is (A + B) / 2. Since A and B are independent and have the same mean, the variance of (A - B)
/// / 2 is that of (A + B) / 2, so its size says how far the picture is from the one with infinitely many samples.
struct Reference {
  Image picture;         ///< linear radiance, rounded to float in the end
  double own_error = 0;  ///< root mean square of (A - B) / 2 over all channels of all pixels, to compare with an RMSE
  /// Mean of ((A - B) / 2)^2 / (picture + 0.01)^2, to compare with PictureError::relative_mean_square.
  double own_relative_mean_square = 0;
  std::uint64_t rays = 0;   ///< traced for it, of all kinds
  double seconds = 0;       ///< wall clock, when it was computed
  bool from_cache = false;  ///< it was computed by an earlier call
};

/// $XDG_CACHE_HOME/dmpc or ~/.cache/dmpc; nothing if neither variable holds an absolute path.
std::optional<std::filesystem::path> default_reference_folder();

/// The reference of `scene` looked at as `picture` says: its resolution (the view's own if not given), depth and convention; its
/// samples and scene name play no role. Computed with all cores, in double precision and world coordinates (tracer.h), unless the
/// folder has it already; then kept there as KEY.exr and KEY.json. KEY depends on everything that the bits depend on: the
/// scene's content (not its name), view, resolution, depth, convention, samples, seed and the version of this renderer. Files
/// that are damaged or do not belong together are computed again. The bits are the same for every number of cores and whether
/// they were kept or not.
///
/// Progress counts rows of both halves, and is not called for what was kept. Throws Interrupted when a stop is requested,
/// core::InputError if the folder or the files cannot be written (said before anything is computed, where it can be known).
/// Not to be called by several threads at once; several processes may share a folder.
Reference reference_for(const core::Scene& scene, const PictureOptions& picture, const ReferenceOptions& options,
                        const Attendance& attendance = {});

}  // namespace dmpc::apps
