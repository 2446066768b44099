// The strength of a point light by direction and distance, in eight bytes.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/vec.h"

namespace dmpc::core {

/// The falloff of a spot light from 1 to 0 as a function of t, which is linear in the cosine: t, 3 t^2 - 2 t^3 or t^2.
enum class ConeEdge : std::uint8_t { linear, smooth, square };

/// The cone of a spot light.
struct LightCone {
  Vec3d ahead;                       ///< unit length
  double full_degrees = 0;           ///< full strength within this angle from `ahead`
  double none_degrees = 0;           ///< dark beyond this angle, up to 180; 0: in all directions
  ConeEdge edge = ConeEdge::linear;  ///< in between
};

/// All 0: equal strength everywhere, like NFF's lights.
struct LightSpread {
  std::array<std::uint16_t, 2> ahead{};  ///< direction as a position on the unfolded unit octahedron
  /// Angles in units of 180 degrees / 32,767, each with a flag. They are swapped for a square edge.
  std::uint16_t full = 0, none = 0;

  static constexpr std::uint16_t flag = 0x8000;
  constexpr bool falls_off() const { return (full & flag) != 0; }
  constexpr bool is_smooth() const { return (none & flag) != 0; }
  constexpr bool is_square() const { return (full & ~flag) > (none & ~flag); }
  constexpr bool is_cone() const { return ((full | none) & ~flag) != 0; }
  constexpr bool is_plain() const { return !falls_off() && !is_cone(); }
};

/// `falls_off`: with the square of the distance. Angles and directions are rounded to some 1e-4 radians.
LightSpread spread_of(const LightCone& cone, bool falls_off);
/// The strength of a light relative to that ahead at distance 1, at a point from which the light is seen in the unit direction
/// `towards` at this distance. 0 where it is dark.
double share_of(const LightSpread& spread, const Vec3d& towards, double distance);

}  // namespace dmpc::core
