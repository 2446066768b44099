// The footprint of a ray's cone on a texture: where a look-up places its probes, and how wide they are.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "core/record/record.h"

namespace dmpc::core {

/// A point on a texture, or an offset: s to the right, t downwards.
struct TexturePlace {
  double s = 0, t = 0;
};

/// The ellipse that a ray's cross-section one grid-local unit wide covers on a triangle's plane: the change of the weights of
/// vertices 1 and 2 along two conjugate diameters.
struct CutEllipse {
  std::array<std::array<float, 2>, 2> axis{};
};
static_assert(std::is_trivially_copyable_v<CutEllipse>);

/// The area of a look-up's mean: a line of probes side by side.
struct TextureFootprint {
  TexturePlace middle;
  TexturePlace stride;  ///< from probe to probe along the line
  double width = 0;     ///< a probe's, in texels of the finest level; not below 0
  double strides = 1;   ///< the length of the line: 1 to probes_max
};

/// Maximum number of probes of a look-up. A longer footprint has wider ones.
inline constexpr double probes_max = 15;

/// The width of one texture's texel, in texels of another at the same place.
inline double texels_of_other(const TextureReference& texture, const TextureReference& other) {
  const auto count = [](const TextureReference& any) { return static_cast<double>(any.width) * any.height; };
  return std::sqrt(count(other) / count(texture));
}

/// The footprint of a cone of this width, grid-local, around the triangle's point with weights u and v. On the texture it covers
/// an ellipse (P. Heckbert, "Fundamentals of Texture Mapping and Image Warping", 1989), sampled by probes along its longer axis
/// (J. McCormack and others, "Feline: Fast Elliptical Lines for Anisotropic Texture Mapping", SIGGRAPH 1999). The probes' middles
/// stay within the bounding rectangle of the triangle's corners on the texture: beyond it a texture may show something else, and
/// a node that has the triangle need not have the tiles.
TextureFootprint footprint_of(const TexturedNormals& triangle, double u, double v, const CutEllipse& ellipse, double cone_width);

}  // namespace dmpc::core
