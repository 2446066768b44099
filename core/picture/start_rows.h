// Where rays leave the hits of a bundle, side by side.
#pragma once

#include <cstddef>

#include "core/base/vec.h"
#include "core/picture/hit_state.h"
#include "core/picture/lanes.h"

namespace dmpc::core {

/// A row for each number that start_towards() and leave() ask of a hit, by lane.
class StartRows {
 public:
  void put_hit(std::size_t lane, const HitState& state) {
    put(point_, lane, state.point);
    put(true_normal_, lane, state.geometric_normal);
    along_[lane] = state.clearance.along;
    across_[lane] = state.clearance.across;
    radius_[lane] = state.clearance.radius;
  }
  /// See lanes.h.
  void fill_up(std::size_t count) {
    core::fill_up(point_, count);
    core::fill_up(true_normal_, count);
    core::fill_up(along_, count);
    core::fill_up(across_, count);
    core::fill_up(radius_, count);
  }
  Vec3d point(std::size_t lane) const { return get(point_, lane); }
  Vec3d true_normal(std::size_t lane) const { return get(true_normal_, lane); }
  Clearance clearance(std::size_t lane) const { return {along_[lane], across_[lane], radius_[lane]}; }

 private:
  VectorRows point_, true_normal_;
  Row<double> along_, across_, radius_;
};

}  // namespace dmpc::core
