// A filtered look-up in a texture in double precision: what core/picture's footprints and look-ups are defined to give, by
// arithmetic of its own.
#pragma once

#include <array>

#include "core/base/vec.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

/// (s, t) on a texture: to the right and downwards, 0 to 1 over the whole.
using ReferencePlace = std::array<double, 2>;

/// A textured triangle as its texture sees it.
struct ReferencePaint {
  std::array<core::Vec3d, 3> corner;
  std::array<ReferencePlace, 3> place;  ///< the corners' texture coordinates
};

/// What a look-up is the mean over: a line about `middle`, `strides` long, of probes of `width` texels.
struct ReferenceFootprint {
  ReferencePlace middle{}, stride{};
  double width = 0, strides = 1;
};

/// Two steps from a ray, in world units, that span what it stands for.
using ReferenceReach = std::array<core::Vec3d, 2>;

/// Reach of a cone around a unit direction, `width` wide.
ReferenceReach cone_about(const core::Vec3d& direction, double width);

/// The footprint of what a ray along `direction` stands for, where it meets the triangle in the point with these weights of its
/// corners. What has no width sees a point.
ReferenceFootprint footprint_of(const ReferencePaint& paint, const core::Texture& texture, const std::array<double, 3>& weight,
                                const core::Vec3d& direction, const ReferenceReach& reach);

/// Linear light, and what of it is there.
struct ReferenceTexel {
  core::Vec3d light;
  double alpha = 0;

  ReferenceTexel operator+(const ReferenceTexel& other) const { return {light + other.light, alpha + other.alpha}; }
  ReferenceTexel operator*(double share) const { return {light * share, alpha * share}; }
};

/// The mean of alpha and, in linear light, of what of the texels is there.
ReferenceTexel texture_sum(const core::Texture& texture, const ReferenceFootprint& footprint);

}  // namespace dmpc::apps
