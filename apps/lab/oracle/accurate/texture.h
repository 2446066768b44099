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

/// The footprint of a cone `cone` wide, in world units, where its axis meets the triangle in the point with these weights of its
/// corners. A cone of no width sees a point.
AccurateFootprint footprint_of(const AccuratePaint& paint, const core::Texture& texture, const std::array<double, 3>& weight,
                               const core::Vec3d& direction, double cone);

/// The mean, in linear light.
core::Vec3d texture_color(const core::Texture& texture, const AccurateFootprint& footprint);

}  // namespace dmpc::apps
