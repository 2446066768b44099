// How light gets about in a picture: by Whitted's mirrors alone, or along paths that surfaces scatter.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "core/base/vec.h"

namespace dmpc::core {

/// whitted: a hit sends a mirrored and a refracted ray, and shows lights (T. Whitted, "An Improved Illumination Model for Shaded
/// Display", 1980). paths: it sends one ray of those, or one that it scatters (J. T. Kajiya, "The Rendering Equation", 1986).
enum class TransportKind : std::uint8_t { whitted, paths };

/// A part of the picture's settings, which every node has by value; with whitted the other members mean nothing.
struct Transport {
  TransportKind kind = TransportKind::whitted;
  /// What rays that meet nothing find is a sky, which surfaces show; else a backdrop, which the eye alone sees, and mirrors and
  /// glass before it: NFF's background.
  bool has_sky = false;
  /// For tests alone: emitters that hits aim at count in full there, and not where paths meet them.
  bool only_aims = false;
  bool never_aims = false;    ///< for tests alone: the sky's picture counts in full where paths meet it, and nobody aims at it
  bool has_gradient = false;  ///< the sky changes from the header's background at the horizon, and below, to `zenith`
  /// From the hit of this number on, the eye's being the first, paths may end by roulette.
  std::uint8_t roulette_from = 3;
  Color zenith;  ///< with a gradient
  Vec3f up;      ///< the zenith's direction, grid-local, of unit length

  constexpr bool is_by_paths() const { return kind == TransportKind::paths; }
};
static_assert(std::is_trivially_copyable_v<Transport>);

/// What comes from a sky that is no picture along the unit direction, where its horizon has the colour `horizon`: in proportion
/// to the sine of how high that points.
inline Color sky_light(const Transport& transport, const Color& horizon, const Vec3f& direction) {
  const float height = transport.has_gradient ? std::clamp(dot(direction, transport.up), 0.0F, 1.0F) : 0.0F;
  return height > 0.0F ? horizon * (1.0F - height) + transport.zenith * height : horizon;
}

}  // namespace dmpc::core
