// Mirrored and refracted rays, found side by side.
#pragma once

#include <cstddef>

#include "core/base/vec.h"
#include "core/picture/hit_state.h"
#include "core/picture/lanes.h"
#include "core/picture/ray_start.h"
#include "core/picture/start_rows.h"

namespace dmpc::core {

/// Up to bundle_rays_max hits side by side, a row for each of their numbers.
class ChildLanes {
 public:
  /// Adds a hit that sends such a ray; its relative_index() is read for bent ones only. Requires room.
  void add(const HitState& state, double index) {
    put(direction_, count_, state.ray.full_direction());
    put(normal_, count_, state.normal);
    starts_.put_hit(count_, state);
    index_[count_++] = index;
  }
  /// How each mirrors, or lets through, its ray: towards() and start() tell, with the bits of normalize() of
  /// mirrored_direction() or bent_direction(), and of start_towards().
  void mirror(VectorWidth width = vector_width());
  void bend(VectorWidth width = vector_width());

  Vec3d towards(std::size_t lane) const { return get(towards_, lane); }
  RayStart start(std::size_t lane) const { return starts_.start(lane); }

 private:
  template <bool is_bent>
  void send_lanes();

  std::size_t count_ = 0;
  VectorRows direction_{}, normal_{};
  Row<double> index_{};
  VectorRows towards_;
  StartRows starts_;
};

}  // namespace dmpc::core
