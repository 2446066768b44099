// A plain path tracer of our scenes, as a good engineer would write it over Embree: what our own paths are held against.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "apps/lab/bench/speed/plain_renderer.h"
#include "apps/scene/subject.h"

namespace dmpc::apps {

class PlainStage;

/// Paths in single precision, one ray at a time asked of Embree's robust tree, otherwise as PlainRenderer: one process, one copy
/// of the scene, threads that take tiles, nothing emulated. The numbers of chance are ours (core/picture/sample_pair.h), and for
/// the same purposes, as are the places in pixels, the ways in which a surface sends light on, roulette, sky and last looks; so
/// sample for sample its light is ours, but where rounding leads a path elsewhere. No textures, no occlusion. Immutable; render()
/// is thread-safe.
class PlainPathRenderer {
 public:
  /// Builds the tree, of high quality, on all cores. `subject`, whose picture is by paths, outlives it.
  explicit PlainPathRenderer(const Subject& subject);
  ~PlainPathRenderer();
  PlainPathRenderer(const PlainPathRenderer&) = delete;
  PlainPathRenderer& operator=(const PlainPathRenderer&) = delete;

  /// As many samples a pixel as the subject's camera has.
  PlainPicture render(std::uint32_t thread_count) const;

 private:
  class Walker;
  std::unique_ptr<PlainStage> stage_;
};

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
