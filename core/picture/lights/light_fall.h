// Illumination of hits by a point light, of one hit or of many side by side.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/base/vec.h"
#include "core/picture/hits/hit_state.h"
#include "core/picture/hits/lanes.h"
#include "core/picture/hits/ray_start.h"

namespace dmpc::core {

/// A shadow ray ends this share of its length before the light.
inline constexpr double light_gap = 1e-6;

/// How a light illuminates a hit, whether or not the surface faces the light.
struct LightFall {
  Vec3d towards;  ///< unit direction to the light; 0 in the light itself
  double cosine;  ///< between `towards` and the shading normal
};

/// `way` normalised; 0 if its length is 0.
inline Vec3d direction_of(const Vec3d& way, double length) {
  const double reciprocal = 1.0 / length;
  return way * (length > 0.0 ? reciprocal : 0.0);
}

/// The cosine between the mirrored ray and the direction `towards` the light; Phong's highlight is a power of it.
inline double lobe_cosine(const Vec3d& direction, const Vec3d& normal, const Vec3d& towards) {
  return dot(mirrored_direction(direction, normal), towards);
}

/// Sets start, direction and end of a shadow ray that leaves a point `towards` a light. If its start lies off the line to the
/// light, the direction is recomputed.
inline void aim_shadow(Ray& ray, const Vec3d& light, const Vec3d& point, const Vec3d& true_normal, const Vec3d& towards,
                       double distance, const RayStart& start) {
  leave(ray, point, true_normal, towards, start);
  const bool is_off = start.across != 0.0;
  const Vec3d from_start = light - ray.full_origin();
  const double length_from_start = length(from_start), length_left = is_off ? length_from_start : distance - start.along;
  const Vec3d anew = from_start * (1.0 / length_from_start);
  ray.go_along({is_off ? anew.x : towards.x, is_off ? anew.y : towards.y, is_off ? anew.z : towards.z});
  ray.t_max = static_cast<float>(length_left * (1.0 - light_gap));
}

/// Up to bundle_rays_max hits side by side, one row per value.
class LitLanes {
 public:
  /// Adds a hit that has come to its lights. Requires a free lane.
  void add(const HitState& state) {
    put(normal_, count_, state.normal);
    put(direction_, count_, state.ray.full_direction());
    starts_.put_hit(count_, state);
    shine_[count_++] = double{std::max(state.surface.material.shine, 0.0F)};  // not what marks microfacets
  }
  /// Computes the illumination of all hits by a light, for fall(), highlight() and set_way(), with the bits that each has alone.
  void light(const Vec3d& position, VectorWidth width = vector_width());

  LightFall fall(std::size_t lane) const { return {get(towards_, lane), cosine_[lane]}; }
  /// lobe_cosine() to the power of the material's shine.
  double highlight(std::size_t lane) const { return highlight_[lane]; }
  /// As aim_shadow() does.
  void set_way(std::size_t lane, Ray& shadow) const { rays_.set(lane, shadow); }

 private:
  void light_lanes(Vec3d position);
  void aim_lanes(Vec3d position);

  std::size_t count_ = 0;
  VectorRows normal_, direction_;
  Row<double> shine_;
  StartRows starts_;
  VectorRows towards_;
  Row<double> distance_, cosine_, highlight_;
  RayRows rays_;
};

}  // namespace dmpc::core
