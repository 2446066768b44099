// How a point light's strength changes with the way from it, in eight bytes.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/vec.h"

namespace dmpc::core {

/// How a cone's strength goes from 1 to 0, of t, which does so in proportion to the cosine: t, 3 t^2 - 2 t^3 or t^2.
enum class ConeEdge : std::uint8_t { linear, smooth, square };

/// Where a light shines that does not shine all round.
struct LightCone {
  Vec3d ahead;                       ///< of unit length
  double full_degrees = 0;           ///< up to so far from `ahead` it is as bright as there
  double none_degrees = 0;           ///< from here on it is dark, up to 180; 0: it shines all round
  ConeEdge edge = ConeEdge::linear;  ///< between both
};

/// All of it 0: as bright everywhere, as NFF's lights are.
struct LightSpread {
  std::array<std::uint16_t, 2> ahead{};  ///< where a direction lies on the unit octahedron, unfolded
  /// Angles, in steps of which 32,767 are 180 degrees; with a flag each. Of a square edge they have changed places.
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
/// By how much a light is weaker than it is ahead, 1 away, at a place from which it is seen `towards` this direction of unit
/// length, so far away. 0 where it is dark.
double share_of(const LightSpread& spread, const Vec3d& towards, double distance);

}  // namespace dmpc::core
