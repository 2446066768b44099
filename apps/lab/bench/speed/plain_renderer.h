// A plain renderer of our scenes, as a good engineer would write it over Embree: our own renderer is compared with it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "apps/frontend/system/stopwatch.h"
#include "apps/scene/subject.h"
#include "core/base/vec.h"
#include "core/base/zeroed_array.h"
#include "core/picture/film/film.h"

namespace dmpc::apps {

class PlainStage;

struct PlainPicture {
  core::ZeroedArray<core::Color> pixels;  ///< linear radiance, row by row from the top left
  std::uint64_t rays = 0;                 ///< rays of all kinds
};

/// Recursive shading after Whitted in single precision: single rays in Embree's robust tree, one process, one copy of the scene,
/// and threads that take the next tile of the picture when they finish one. It emulates nothing, counts only rays, and guarantees
/// no equal bits. The rays are ours: Haines' convention, the same offsets, and the same rays left out because they cannot
/// contribute. Spheres and cones, which Embree lacks, are its user geometry (PlainQuadric); beside them eye rays, and those of
/// mirrors and glass, are in double precision, since curved mirrors multiply what rounding leaves. There are no textures.
///
/// If the subject's picture is by paths, these are ours, too: the random numbers (core/picture/sampling/sample_pair.h) and their
/// purposes, positions in pixels, the scattering of surfaces with microfacets, light sampling and its weights, roulette, sky and
/// last looks. So its light is ours sample for sample, except where rounding leads a path elsewhere. A sky has no picture.
/// Otherwise there is at most one sample a pixel. Immutable; render() is thread-safe.
class PlainRenderer {
 public:
  /// Builds the tree, of high quality, on all cores. `subject` outlives it.
  explicit PlainRenderer(const Subject& subject);
  ~PlainRenderer();
  PlainRenderer(const PlainRenderer&) = delete;
  PlainRenderer& operator=(const PlainRenderer&) = delete;

  /// Its time includes memory for the picture and the start of the threads.
  PlainPicture render(std::uint32_t thread_count) const;
  /// Returns the times that Embree needed for its tree, from prepared vertices.
  const Times& build_times() const;

 private:
  std::unique_ptr<PlainStage> stage_;
};

/// The largest allowed root mean square difference of a plain picture from ours, in linear radiance.
inline constexpr double plain_error_max = 1.0 / 255;

/// Returns the difference from our film of `scene`. Throws core::InternalError if it is more than plain_error_max.
double distance_to_ours(const PlainPicture& picture, const core::Film& film, const std::string& scene);

/// Root mean squares, linear: the difference of a plain picture from ours, and our noise, as estimated from its two planes.
struct PathDistance {
  double apart = 0, noise = 0;
};

/// The largest allowed difference, over the noise of ours: most samples have one path in both.
inline constexpr double path_distance_max = 0.5;

/// Returns the distance to our film of `scene`, with 16 or more samples a pixel. Throws core::InternalError if the pictures
/// differ by more than path_distance_max of their noise, or their means by more than a hundredth of the light.
PathDistance path_distance(const PlainPicture& picture, const core::Film& film, const std::string& scene);

}  // namespace dmpc::apps
