// The only loop here is vectorised by compilers, once for each width of vectors: its body is one straight line, and
// CMakeLists.txt lets them compute what a choice then leaves out.
#include "core/picture/light_fall.h"

#include <hwy/targets.h>

#include "core/base/exponents.h"

namespace dmpc::core {
namespace {

/// Lanes that a vector holds at most; beyond those that are taken, lanes of such a group are computed for nothing.
constexpr std::size_t group_lanes = 8;

}  // namespace

[[gnu::always_inline]] inline void LitLanes::light_lanes(Vec3d position) {
  const std::size_t end = (count_ + group_lanes - 1) / group_lanes * group_lanes;
  for (std::size_t lane = 0; lane < end; ++lane) {
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

[[gnu::target("arch=x86-64-v4"), gnu::flatten]] void LitLanes::light_by_512(const Vec3d& position) {
  light_lanes(position);
}

[[gnu::target("arch=x86-64-v3"), gnu::flatten]] void LitLanes::light_by_256(const Vec3d& position) { light_lanes(position); }

void LitLanes::light_plainly(const Vec3d& position) { light_lanes(position); }

void LitLanes::light(const Vec3d& position) {
  static const auto widest = [] {
    const auto targets = hwy::SupportedTargets();
    return (targets & HWY_AVX3) != 0   ? &LitLanes::light_by_512
           : (targets & HWY_AVX2) != 0 ? &LitLanes::light_by_256
                                       : &LitLanes::light_plainly;
  }();
  (this->*widest)(position);
}

}  // namespace dmpc::core
