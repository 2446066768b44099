// What a surface of the plain path tracer does with light, in single precision.
#pragma once

#include <limits>
#include <optional>

#include "apps/lab/bench/speed/plain_stage.h"
#include "core/base/vec.h"
#include "core/picture/sample_pair.h"

namespace dmpc::apps {

/// One way in which a surface sends light on.
struct PlainWay {
  core::Vec3f towards;  ///< of unit length
  core::Color weight;
  bool is_scattered = false;
  float density = std::numeric_limits<float>::infinity();  ///< of the direction, per steradian; of mirror and glass infinite
};

/// NFF's surface, a matt part, a mirror and what lets through, or one of tiny mirrors over a matt part: the formulas of ours
/// (core/picture/path_step.h, core/picture/microfacet_lobes.h), whose ways are chosen by the same shares.
class PlainLobes {
 public:
  /// Of a hit by a ray that comes along `direction`. `material` and `surface` outlive it.
  PlainLobes(const PlainMaterial& material, const PlainSurface& surface, const core::Vec3f& direction);

  struct Response {
    core::Color value;  ///< of a radiance of 1 from there, per steradian, the cosine included
    float density = 0;  ///< of ways there
  };
  /// To light from the unit direction `in`: nothing below the surface, wherever a blended normal points.
  Response response(const core::Vec3f& in) const;
  /// Whether that is above 0 from anywhere.
  bool scatters() const { return scattered_ > 0 || (is_spread() && mirrored_ > 0); }
  /// Chosen in proportion to the brightest channels of all; nothing if it leads nowhere.
  std::optional<PlainWay> way(const core::SamplePair& choice, const core::SamplePair& direction) const;

 private:
  void begin_plain();
  void begin_facets();
  float all() const { return scattered_ + mirrored_ + through_; }
  /// Of tiny mirrors that differ in direction.
  bool is_spread() const;
  float unreflected(float cosine) const;
  core::Color mirrored_share(float cosine) const;
  std::optional<PlainWay> spread(const core::Vec3f& in) const;
  core::Vec3f tiny_mirrored(const core::SamplePair& direction) const;
  core::Vec3f bent() const;

  const PlainMaterial& material_;
  const PlainSurface& surface_;
  core::Vec3f direction_, out_;  ///< whence it comes, or above the normal beside that
  float cosine_, index_, behind_;
  bool is_total_;                         ///< by Snell's law nothing gets through
  core::Color matt_, straight_, mirror_;  ///< scattered; reflected straight ahead; and by a mirror
  float scattered_ = 0, mirrored_ = 0, through_ = 0;
};

}  // namespace dmpc::apps
