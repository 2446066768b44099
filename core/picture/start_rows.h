// Where rays leave the hits of a bundle, side by side.
#pragma once

#include <cstddef>

#include "core/base/vec.h"
#include "core/picture/hit_state.h"
#include "core/picture/lanes.h"
#include "core/picture/ray_start.h"

namespace dmpc::core {

/// A row for each number of start_towards(), by lane.
class StartRows {
 public:
  void put_hit(std::size_t lane, const HitState& state) {
    put(true_normal_, lane, state.geometric_normal);
    along_[lane] = state.clearance.along;
    across_[lane] = state.clearance.across;
    radius_[lane] = state.clearance.radius;
  }
  /// For loops that compilers vectorise.
  void find(std::size_t lane, const Vec3d& towards) {
    const RayStart start = start_towards(towards, get(true_normal_, lane), {along_[lane], across_[lane], radius_[lane]});
    start_along_[lane] = start.along;
    start_across_[lane] = start.across;
  }
  RayStart start(std::size_t lane) const { return {start_along_[lane], start_across_[lane]}; }

 private:
  VectorRows true_normal_{};
  Row<double> along_{}, across_{}, radius_{};
  Row<double> start_along_, start_across_;
};

}  // namespace dmpc::core
