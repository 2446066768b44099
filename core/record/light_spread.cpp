#include "core/record/light_spread.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/elementary.h"

namespace dmpc::core {
namespace {

constexpr double angle_steps = 32767, place_steps = 65535;

std::uint16_t angle_bits(double degrees) {
  return static_cast<std::uint16_t>(std::clamp(degrees, 0.0, 180.0) / 180.0 * angle_steps + 0.5);
}

double degrees_of(std::uint16_t bits) { return (bits & ~LightSpread::flag) * (180.0 / angle_steps); }

std::uint16_t place_bits(double place) {
  return static_cast<std::uint16_t>((std::clamp(place, -1.0, 1.0) + 1.0) * (0.5 * place_steps) + 0.5);
}

double place_of(std::uint16_t bits) { return bits * (2.0 / place_steps) - 1.0; }

double with_sign_of(double value, double sign) { return sign < 0.0 ? -value : value; }

/// Folds the lower half of the octahedron outwards over the corners of the square.
std::array<double, 2> folded(double x, double y) {
  return {with_sign_of(1.0 - std::fabs(y), x), with_sign_of(1.0 - std::fabs(x), y)};
}

Vec3d direction_of(const std::array<std::uint16_t, 2>& bits) {
  const double x = place_of(bits[0]), y = place_of(bits[1]), z = 1.0 - std::fabs(x) - std::fabs(y);
  const std::array<double, 2> below = folded(x, y);
  return normalize(z < 0.0 ? Vec3d{below[0], below[1], z} : Vec3d{x, y, z});
}

}  // namespace

LightSpread spread_of(const LightCone& cone, bool falls_off) {
  LightSpread spread{.full = falls_off ? LightSpread::flag : std::uint16_t{0}};
  if (!(cone.none_degrees > 0.0)) {
    return spread;
  }
  const double sum = std::fabs(cone.ahead.x) + std::fabs(cone.ahead.y) + std::fabs(cone.ahead.z);
  const Vec3d on = cone.ahead * (sum > 0.0 ? 1.0 / sum : 0.0);
  const std::array<double, 2> place = on.z < 0.0 ? folded(on.x, on.y) : std::array{on.x, on.y};
  spread.ahead = {place_bits(place[0]), place_bits(place[1])};
  std::uint16_t none = std::max<std::uint16_t>(angle_bits(cone.none_degrees), 1);
  std::uint16_t full = std::min(angle_bits(cone.full_degrees), none);
  if (cone.edge == ConeEdge::square) {
    std::swap(full, none);
  }
  spread.full = static_cast<std::uint16_t>(spread.full | full);
  spread.none = static_cast<std::uint16_t>(none | (cone.edge == ConeEdge::smooth ? LightSpread::flag : 0U));
  return spread;
}

double share_of(const LightSpread& spread, const Vec3d& towards, double distance) {
  const double fall = spread.falls_off() ? 1.0 / (distance * distance) : 1.0;
  if (!spread.is_cone()) {
    return fall;
  }
  const bool is_square = spread.is_square();
  const double cosine = -dot(towards, direction_of(spread.ahead)),
               none = cos_degrees(degrees_of(is_square ? spread.full : spread.none)),
               full = cos_degrees(degrees_of(is_square ? spread.none : spread.full));
  if (cosine >= full || !(cosine > none)) {
    return cosine >= full ? fall : 0.0;
  }
  const double t = (cosine - none) / (full - none);
  return fall * (is_square ? t * t : spread.is_smooth() ? t * t * (3.0 - 2.0 * t) : t);
}

}  // namespace dmpc::core
