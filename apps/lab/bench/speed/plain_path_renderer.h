// A plain path tracer of our scenes, as a good engineer would write it over Embree: what our own paths are held against.
#pragma once

#include <cstdint>
#include <memory>

#include "apps/lab/bench/speed/plain_renderer.h"
#include "apps/scene/subject.h"

namespace dmpc::apps {

class PlainStage;

/// Paths in single precision, one ray at a time asked of Embree's robust tree, otherwise as PlainRenderer: one process, one copy
/// of the scene, threads that take tiles, nothing emulated. The numbers of chance are ours (core/picture/sample_pair.h), and for
/// the same purposes, as are the places in pixels, the ways in which a surface sends light on, tiny mirrors included, what hits
/// aim at and how that is weighed, roulette, sky and last looks; so sample for sample its light is ours, but where rounding leads
/// a path elsewhere. No textures, no sky's picture, no occlusion. Immutable; render() is
/// thread-safe.
class PlainPathRenderer {
 public:
  /// Builds the tree, of high quality, on all cores. `subject`, whose picture is by paths, below a sky of colours if it has one,
  /// outlives it.
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

}  // namespace dmpc::apps
