// How a point light falls on hits, of one or of many side by side.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/base/vec.h"
#include "core/picture/hit_state.h"
#include "core/picture/lanes.h"
#include "core/picture/ray_start.h"
#include "core/picture/start_rows.h"

namespace dmpc::core {

/// How a light falls on a hit: all of it, whether or not the surface faces the light.
struct LightFall {
  Vec3d towards;    ///< the light, unit length; 0 in the light itself
  double distance;  ///< of the light, grid-local
  double cosine;    ///< of `towards` with the shading normal
  RayStart start;   ///< of a shadow ray
};

/// `way` scaled to length 1; 0 if it has none.
inline Vec3d direction_of(const Vec3d& way, double length) {
  const double reciprocal = 1.0 / length;
  return way * (length > 0.0 ? reciprocal : 0.0);
}

/// The cosine between the mirrored ray and the way `towards` the light, of which Phong's highlight is a power.
inline double lobe_cosine(const Vec3d& direction, const Vec3d& normal, const Vec3d& towards) {
  return dot(mirrored_direction(direction, normal), towards);
}

inline LightFall fall_on(const HitState& state, const Vec3d& light) {
  const Vec3d way = light - state.point;
  const double distance = length(way);
  const Vec3d towards = direction_of(way, distance);
  return {towards, distance, dot(towards, state.normal), start_towards(towards, state.geometric_normal, state.clearance)};
}

/// Up to bundle_rays_max hits side by side, a row for each of their numbers.
class LitLanes {
 public:
  /// Adds a hit that has come to its lights. Requires room.
  void add(const HitState& state) {
    put(point_, count_, state.point);
    put(normal_, count_, state.normal);
    put(direction_, count_, state.ray.full_direction());
    starts_.put_hit(count_, state);
    shine_[count_++] = double{std::max(state.surface.material.shine, 0.0F)};  // not what marks microfacets
  }
  /// How a light falls on all: fall() and highlight() tell, with the bits of fall_on() and of pow_unit().
  void light(const Vec3d& position, VectorWidth width = vector_width());

  LightFall fall(std::size_t lane) const { return {get(towards_, lane), distance_[lane], cosine_[lane], starts_.start(lane)}; }
  /// lobe_cosine() to the power of the material's shine.
  double highlight(std::size_t lane) const { return highlight_[lane]; }

 private:
  void light_lanes(Vec3d position);

  std::size_t count_ = 0;
  VectorRows point_{}, normal_{}, direction_{};
  Row<double> shine_{};
  VectorRows towards_;
  StartRows starts_;
  Row<double> distance_, cosine_, highlight_;
};

}  // namespace dmpc::core
