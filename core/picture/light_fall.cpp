#include "core/picture/light_fall.h"

#include "core/base/exponents.h"

namespace dmpc::core {

[[gnu::always_inline]] inline void LitLanes::light_lanes(Vec3d position) {
  for (std::size_t lane = 0; lane < whole_groups(count_); ++lane) {
    const Vec3d way = position - get(point_, lane), normal = get(normal_, lane);
    const double distance = length(way);
    const Vec3d towards = direction_of(way, distance);
    put(towards_, lane, towards);
    distance_[lane] = distance;
    cosine_[lane] = dot(towards, normal);
    starts_.find(lane, towards);
    highlight_[lane] = unit_power(lobe_cosine(get(direction_, lane), normal, towards), shine_[lane]);
  }
}

void LitLanes::light(const Vec3d& position, VectorWidth width) {
  run_by(width, [this, position] { light_lanes(position); });
}

}  // namespace dmpc::core
