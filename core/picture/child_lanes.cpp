#include "core/picture/child_lanes.h"

#include "core/picture/ray_start.h"

namespace dmpc::core {

template <bool is_bent>
[[gnu::always_inline]] inline void ChildLanes::send_lanes() {
  for (std::size_t first = 0; first < count_; first += group_lanes) {
    for (std::size_t lane = first; lane < first + group_lanes; ++lane) {
      const Vec3d direction = get(direction_, lane), normal = get(normal_, lane);
      const Vec3d towards =
          normalize(is_bent ? bent_direction(direction, normal, index_[lane]) : mirrored_direction(direction, normal));
      const Vec3d true_normal = starts_.true_normal(lane);
      Ray ray;
      leave(ray, starts_.point(lane), true_normal, towards, start_towards(towards, true_normal, starts_.clearance(lane)));
      rays_.put(lane, ray);
    }
  }
}

void ChildLanes::fill_up() {
  core::fill_up(direction_, count_);
  core::fill_up(normal_, count_);
  core::fill_up(index_, count_);
  starts_.fill_up(count_);
}

void ChildLanes::mirror(VectorWidth width) {
  fill_up();
  run_by(width, [&] { send_lanes<false>(); });
}

void ChildLanes::bend(VectorWidth width) {
  fill_up();
  run_by(width, [&] { send_lanes<true>(); });
}

}  // namespace dmpc::core
