// A plain renderer of our scenes, as a good engineer would write it over Embree: what all our own is held against.
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

/// Recursive shading after Whitted in single precision, one ray at a time asked of Embree's robust tree, one process, one copy of
/// the scene, and threads that take the next tile of the picture when they are done with one. It emulates nothing, counts nothing
/// but rays and keeps no two pictures equal. The rays are ours: Haines' convention, the same offsets, the same left out for what
/// they cannot bring. Spheres and cones, of which Embree knows nothing, are ours in double precision. No textures.
///
/// By paths, where the subject's picture is: the numbers of chance are ours (core/picture/sampling/sample_pair.h), and for the
/// same purposes, as are the places in pixels, the ways in which a surface sends light on, tiny mirrors included, what hits aim
/// at and how that is weighed, roulette, sky and last looks; so sample for sample its light is ours, but where rounding leads a
/// path elsewhere. No sky's picture. Else no more than one sample a pixel. Immutable; render() is thread-safe.
class PlainRenderer {
 public:
  /// Builds the tree, of high quality, on all cores. `subject` outlives it.
  explicit PlainRenderer(const Subject& subject);
  ~PlainRenderer();
  PlainRenderer(const PlainRenderer&) = delete;
  PlainRenderer& operator=(const PlainRenderer&) = delete;

  /// Memory for the picture and starting the threads are part of it.
  PlainPicture render(std::uint32_t thread_count) const;
  /// What Embree took for its tree, from vertices that lay ready.
  const Times& build_times() const;

 private:
  std::unique_ptr<PlainStage> stage_;
};

/// The most, root mean square, that a picture of the plain renderer may lie from ours, in linear radiance.
inline constexpr double plain_error_max = 1.0 / 255;

/// How far it lies from our film of `scene`. Throws core::InternalError if that is more than plain_error_max.
double distance_to_ours(const PlainPicture& picture, const core::Film& film, const std::string& scene);

/// Root mean squares, linear: how far a plain picture lies from ours, and how noisy that is, as far as its two planes tell.
struct PathDistance {
  double apart = 0, noise = 0;
};

/// The most that pictures lie apart, over the noise of ours: most samples have one path in both.
inline constexpr double path_distance_max = 0.5;

/// Distance to our film of `scene`, with 16 samples a pixel or more. Throws core::InternalError if the pictures differ by more
/// than path_distance_max of their noise, or their means by more than a hundredth of the light.
PathDistance path_distance(const PlainPicture& picture, const core::Film& film, const std::string& scene);

}  // namespace dmpc::apps
