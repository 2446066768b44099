// What a surface of the plain path tracer does with light, in single precision.
#pragma once

#include <limits>
#include <optional>

#include "apps/lab/bench/speed/plain_stage.h"
#include "apps/lab/oracle/facet_lobes.h"
#include "core/base/vec.h"
#include "core/picture/sampling/sample_pair.h"

namespace dmpc::apps {

/// One way in which a surface sends light on.
struct PlainWay {
  core::Vec3f towards;  ///< unit vector
  core::Color weight;
  bool is_scattered = false;
  float density = std::numeric_limits<float>::infinity();  ///< density of the direction, per steradian; infinite for specular
};

/// NFF's surface, a matt part, a mirror and what lets through, by the formulas of ours (core/picture/surfaces/path_step.h), or
/// one of tiny mirrors over a matt part, as judges have it; ways are chosen by the shares of ours.
class PlainLobes {
 public:
  /// For a hit by a ray along `direction`. `material` and `surface` outlive it.
  PlainLobes(const PlainMaterial& material, const PlainSurface& surface, const core::Vec3f& direction);

  using Response = FacetedResponse<float>;
  /// To light from the unit direction `in`: nothing below the surface, wherever a blended normal points.
  Response response(const core::Vec3f& in) const;
  /// Whether that is above 0 from anywhere.
  bool scatters() const { return facets_ ? facets_->scatters() : scattered_ > 0; }
  /// Chosen in proportion to the brightest channels of all; nothing if it leads nowhere.
  std::optional<PlainWay> way(const core::SamplePair& choice, const core::SamplePair& direction) const;

 private:
  float all() const { return scattered_ + mirrored_ + through_; }

  std::optional<FacetLobes<float>> facets_;  ///< then that is all there is
  const PlainSurface& surface_;
  core::Vec3f direction_;
  float index_, behind_ = 0;
  core::Color matt_, mirror_;  ///< scattered; and reflected by a mirror
  float scattered_ = 0, mirrored_ = 0, through_ = 0;
};

}  // namespace dmpc::apps
