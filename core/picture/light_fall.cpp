#include "core/picture/light_fall.h"

#include "core/base/exponents.h"

namespace dmpc::core {

[[gnu::always_inline]] inline void LitLanes::light_lanes(Vec3d position) {
  for (std::size_t lane = 0; lane < whole_groups(count_); ++lane) {
    const Vec3d way = position - get(point_, lane), normal = get(normal_, lane);
    const double distance = length(way);
    const Vec3d towards = direction_of(way, distance);
    const RayStart start = start_towards(towards, get(true_normal_, lane), {along_[lane], across_[lane], radius_[lane]});
    put(towards_, lane, towards);
    distance_[lane] = distance;
    cosine_[lane] = dot(towards, normal);
    start_along_[lane] = start.along;
    start_across_[lane] = start.across;
    highlight_[lane] = unit_power(lobe_cosine(get(direction_, lane), normal, towards), shine_[lane]);
  }
}

[[gnu::target("arch=x86-64-v4"), gnu::flatten]] void LitLanes::light_by_512(const Vec3d& position) { light_lanes(position); }

[[gnu::target("arch=x86-64-v3"), gnu::flatten]] void LitLanes::light_by_256(const Vec3d& position) { light_lanes(position); }

void LitLanes::light_plainly(const Vec3d& position) { light_lanes(position); }

void LitLanes::light(const Vec3d& position, VectorWidth width) {
  switch (width) {
    case VectorWidth::bits_512:
      return light_by_512(position);
    case VectorWidth::bits_256:
      return light_by_256(position);
    case VectorWidth::any:
      return light_plainly(position);
  }
}

}  // namespace dmpc::core
