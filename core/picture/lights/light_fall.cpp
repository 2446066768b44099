#include "core/picture/lights/light_fall.h"

#include "core/base/exponents.h"

namespace dmpc::core {

[[gnu::always_inline]] inline void LitLanes::light_lanes(Vec3d position) {
  for (std::size_t first = 0; first < count_; first += group_lanes) {
    for (std::size_t lane = first; lane < first + group_lanes; ++lane) {
      const Vec3d way = position - starts_.point(lane), normal = get(normal_, lane);
      const double distance = length(way);
      const Vec3d towards = direction_of(way, distance);
      put(towards_, lane, towards);
      distance_[lane] = distance;
      cosine_[lane] = dot(towards, normal);
      highlight_[lane] = unit_power(lobe_cosine(get(direction_, lane), normal, towards), shine_[lane]);
    }
  }
}

[[gnu::always_inline]] inline void LitLanes::aim_lanes(Vec3d position) {
  for (std::size_t first = 0; first < count_; first += group_lanes) {
    for (std::size_t lane = first; lane < first + group_lanes; ++lane) {
      const Vec3d point = starts_.point(lane), true_normal = starts_.true_normal(lane), towards = get(towards_, lane);
      Ray ray;
      aim_shadow(ray, position, point, true_normal, towards, distance_[lane],
                 start_towards(towards, true_normal, starts_.clearance(lane)));
      rays_.put(lane, ray);
    }
  }
}

void LitLanes::light(const Vec3d& position, VectorWidth width) {
  fill_up(normal_, count_);
  fill_up(direction_, count_);
  fill_up(shine_, count_);
  starts_.fill_up(count_);
  run_by(width, [this, position] {
    light_lanes(position);
    aim_lanes(position);
  });
}

}  // namespace dmpc::core
