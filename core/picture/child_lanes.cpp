#include "core/picture/child_lanes.h"

namespace dmpc::core {

template <bool is_bent>
[[gnu::always_inline]] inline void ChildLanes::send_lanes() {
  for (std::size_t lane = 0; lane < whole_groups(count_); ++lane) {
    const Vec3d direction = get(direction_, lane), normal = get(normal_, lane);
    const Vec3d towards =
        normalize(is_bent ? bent_direction(direction, normal, index_[lane]) : mirrored_direction(direction, normal));
    put(towards_, lane, towards);
    starts_.find(lane, towards);
  }
}

void ChildLanes::mirror(VectorWidth width) {
  run_by(width, [&] { send_lanes<false>(); });
}

void ChildLanes::bend(VectorWidth width) {
  run_by(width, [&] { send_lanes<true>(); });
}

}  // namespace dmpc::core
