// What a ray's cone covers of a texture: where a look-up takes its probes, and how wide they are.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "core/record/record.h"

namespace dmpc::core {

/// A place on a texture, or a way from one to another: s to the right, t downwards.
struct TexturePlace {
  double s = 0, t = 0;
};

/// The ellipse that what a ray stands for, where that is as wide as a grid-local unit, covers of a triangle's plane: how the
/// weights of vertices 1 and 2 change from end to end of two diameters of which each halves the chords along the other.
struct CutEllipse {
  std::array<std::array<float, 2>, 2> axis{};
};
static_assert(std::is_trivially_copyable_v<CutEllipse>);

/// What a look-up is the mean over: a line of probes side by side.
struct TextureFootprint {
  TexturePlace middle;
  TexturePlace stride;  ///< as far as a probe reaches along the line
  double width = 0;     ///< of a probe, in texels of the finest level; not below 0
  double strides = 1;   ///< the length of the line: 1 to probes_max
};

/// Probes of a look-up at most. A footprint that is longer has wider ones.
inline constexpr double probes_max = 15;

/// What is one of a texture's texels wide, in texels of another at the same places.
inline double texels_of_other(const TextureReference& texture, const TextureReference& other) {
  const auto count = [](const TextureReference& any) { return static_cast<double>(any.width) * any.height; };
  return std::sqrt(count(other) / count(texture));
}

/// The footprint of what is so wide, grid-local, about the point of the triangle with weights u and v. What it covers of the
/// texture is an ellipse (P. Heckbert, "Fundamentals of Texture Mapping and Image Warping", 1989), taken by probes along its
/// longer axis (J. McCormack and others, "Feline: Fast Elliptical Lines for Anisotropic Texture Mapping", SIGGRAPH 1999). The
/// middles of probes keep to the rectangle in which the triangle's corners lie on the texture: beyond it a texture may show
/// something else, and whoever has the triangle need not have the tiles.
TextureFootprint footprint_of(const TexturedNormals& triangle, double u, double v, const CutEllipse& ellipse, double cone_width);

}  // namespace dmpc::core
