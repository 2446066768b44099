// A filtered texture look-up in double precision: the result that core/picture's footprints and look-ups are defined to give, by
// independent arithmetic.
#pragma once

#include <array>

#include "core/base/vec.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

/// (s, t) on a texture: to the right and downwards, 0 to 1 over the whole.
using ReferencePlace = std::array<double, 2>;

/// A textured triangle as a look-up needs it.
struct ReferencePaint {
  std::array<core::Vec3d, 3> corner;
  std::array<ReferencePlace, 3> place;  ///< the corners' texture coordinates
};

/// The area that a look-up averages: a line of probes about `middle`, `strides` long, each `width` texels wide.
struct ReferenceFootprint {
  ReferencePlace middle{}, stride{};
  double width = 0, strides = 1;
};

/// Two vectors across a ray, in world units, that span its footprint.
using ReferenceReach = std::array<core::Vec3d, 2>;

/// Returns the reach of a cone around a unit direction, `width` wide.
ReferenceReach cone_about(const core::Vec3d& direction, double width);

/// Returns the footprint of a ray along `direction` where it meets the triangle in the point with these weights of its corners.
/// Without a width it is a point.
ReferenceFootprint footprint_of(const ReferencePaint& paint, const core::Texture& texture, const std::array<double, 3>& weight,
                                const core::Vec3d& direction, const ReferenceReach& reach);

/// Linear light, and the share of it that is present.
struct ReferenceTexel {
  core::Vec3d light;
  double alpha = 0;

  ReferenceTexel operator+(const ReferenceTexel& other) const { return {light + other.light, alpha + other.alpha}; }
  ReferenceTexel operator*(double share) const { return {light * share, alpha * share}; }
};

/// Returns the mean of alpha and, in linear light, of the texels' colours weighted by what is present.
ReferenceTexel texture_sum(const core::Texture& texture, const ReferenceFootprint& footprint);

}  // namespace dmpc::apps
