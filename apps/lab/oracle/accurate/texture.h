// A filtered look-up in a texture in double precision: what core/picture's footprints and look-ups are defined to give, by
// arithmetic of its own.
#pragma once

#include <array>

#include "core/base/vec.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

/// (s, t) on a texture: to the right and downwards, 0 to 1 over the whole.
using AccuratePlace = std::array<double, 2>;

/// A textured triangle as its texture sees it.
struct AccuratePaint {
  std::array<core::Vec3d, 3> corner;
  std::array<AccuratePlace, 3> place;  ///< of the corners
};

/// What a look-up is the mean over: a line about `middle`, `strides` long, of probes of `width` texels.
struct AccurateFootprint {
  AccuratePlace middle{}, stride{};
  double width = 0, strides = 1;
};

/// Two steps from a ray, in world units, that span what it stands for.
using AccurateReach = std::array<core::Vec3d, 2>;

/// Of a cone about a unit direction, `width` wide.
AccurateReach cone_about(const core::Vec3d& direction, double width);

/// The footprint of what a ray along `direction` stands for, where it meets the triangle in the point with these weights of its
/// corners. What has no width sees a point.
AccurateFootprint footprint_of(const AccuratePaint& paint, const core::Texture& texture, const std::array<double, 3>& weight,
                               const core::Vec3d& direction, const AccurateReach& reach);

/// Linear light, and what of it is there.
struct AccurateTexel {
  core::Vec3d light;
  double alpha = 0;

  AccurateTexel operator+(const AccurateTexel& other) const { return {light + other.light, alpha + other.alpha}; }
  AccurateTexel operator*(double share) const { return {light * share, alpha * share}; }
};

/// The mean of alpha and, in linear light, of what of the texels is there.
AccurateTexel texture_sum(const core::Texture& texture, const AccurateFootprint& footprint);

}  // namespace dmpc::apps
