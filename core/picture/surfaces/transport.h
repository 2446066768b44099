// Light transport of a picture: Whitted's mirrors, or paths.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "core/base/vec.h"

namespace dmpc::core {

/// whitted: a hit sends a mirrored and a refracted ray, and shows lights (T. Whitted, "An Improved Illumination Model for Shaded
/// Display", 1980). paths: it sends one of those rays, or one that it scatters (J. T. Kajiya, "The Rendering Equation", 1986).
enum class TransportKind : std::uint8_t { whitted, paths };

/// A part of the picture's settings, copied to every node; with whitted the other members are unused.
struct Transport {
  TransportKind kind = TransportKind::whitted;
  /// The background is a sky, which illuminates surfaces; otherwise it is seen only by the eye, directly or by mirrors and glass:
  /// NFF's background.
  bool has_sky = false;
  /// For tests alone: light sampling has full weight, and emitters that paths hit have none.
  bool only_aims = false;
  bool never_aims = false;    ///< for tests alone: the sky's picture has full weight where paths hit it, and is not sampled
  bool has_gradient = false;  ///< the sky changes from the header's background at the horizon, and below, to `zenith`
  Color zenith;               ///< with a gradient
  Vec3f up;                   ///< the zenith's direction, grid-local, of unit length

  constexpr bool is_by_paths() const { return kind == TransportKind::paths; }
};
static_assert(std::is_trivially_copyable_v<Transport>);

/// The radiance of a sky that is no picture along the unit direction, where its horizon has the colour `horizon`: linear in the
/// sine of the elevation.
inline Color sky_light(const Transport& transport, const Color& horizon, const Vec3f& direction) {
  const float height = transport.has_gradient ? std::clamp(dot(direction, transport.up), 0.0F, 1.0F) : 0.0F;
  return height > 0.0F ? horizon * (1.0F - height) + transport.zenith * height : horizon;
}

}  // namespace dmpc::core
