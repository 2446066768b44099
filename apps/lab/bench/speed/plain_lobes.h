// Scattering at a surface of the plain path tracer, in single precision.
#pragma once

#include <limits>
#include <optional>

#include "apps/lab/bench/speed/plain_stage.h"
#include "apps/lab/oracle/facet_lobes.h"
#include "core/base/vec.h"
#include "core/picture/sampling/sample_pair.h"

namespace dmpc::apps {

/// One direction in which a surface scatters light.
struct PlainWay {
  core::Vec3f towards;  ///< unit vector
  core::Color weight;
  bool is_scattered = false;
  float density = std::numeric_limits<float>::infinity();  ///< density of the direction, per steradian; infinite for specular
};

/// NFF's surface, with a diffuse part, a mirror and transmission, by our formulas (core/picture/surfaces/path_step.h), or a
/// microfacet surface over a diffuse part, as the judges have it; lobes are chosen with our probabilities.
class PlainLobes {
 public:
  /// Made for a hit by a ray along `direction`. `material` and `surface` outlive it.
  PlainLobes(const PlainMaterial& material, const PlainSurface& surface, const core::Vec3f& direction);

  using Response = FacetedResponse<float>;
  /// Returns the response to light from the unit direction `in`: nothing below the surface, wherever an interpolated normal
  /// points.
  Response response(const core::Vec3f& in) const;
  /// Returns whether the response is above 0 for any direction.
  bool scatters() const { return facets_ ? facets_->scatters() : scattered_ > 0; }
  /// Chooses in proportion to the brightest channels of all lobes; returns nothing if no path continues.
  std::optional<PlainWay> way(const core::SamplePair& choice, const core::SamplePair& direction) const;

 private:
  float all() const { return scattered_ + mirrored_ + through_; }

  std::optional<FacetLobes<float>> facets_;  ///< if set, it replaces everything else
  const PlainSurface& surface_;
  core::Vec3f direction_;
  float index_, behind_ = 0;
  core::Color matt_, mirror_;  ///< diffuse reflectance, and that of a mirror
  float scattered_ = 0, mirrored_ = 0, through_ = 0;
};

}  // namespace dmpc::apps
